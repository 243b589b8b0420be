#include "render/osmesa_window.hpp"

#include <GL/osmesa.h>

#include <vtkObjectFactory.h>
#include <vtkObjectFactoryCollection.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>
#include <vtkVersion.h>

#include <cstring>
#include <stdexcept>

#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0)
#error "VTK 9.4 chooses X, EGL or OSMesa itself at run time: this window is not needed"
#endif

// Debian's VTK uses the system's GLEW, which is built for GLX: glewInit() looks every OpenGL
// function up with glXGetProcAddressARB() and then asks GLX for its display and version.  These
// definitions are found before libGL's because they are in the executable; they send the look-ups
// to OSMesa and answer the rest.
extern "C" {

using GlFunction = void (*)();

// GLEW only compares the display with null.
static void* current_display() {
  static char not_null = 0;
  return &not_null;
}

__attribute__((visibility("default"), used)) GlFunction
glXGetProcAddressARB(const unsigned char* name) {
  const char* const text = reinterpret_cast<const char*>(name);
  if (std::strncmp(text, "glX", 3) != 0)
    return reinterpret_cast<GlFunction>(OSMesaGetProcAddress(text));
  const bool display = std::strcmp(text, "glXGetCurrentDisplay") == 0;
  return display ? reinterpret_cast<GlFunction>(&current_display) : nullptr;
}

// 1.2: no more than GLEW can do without a real GLX.
__attribute__((visibility("default"), used)) int glXQueryVersion(void*, int* major, int* minor) {
  *major = 1;
  *minor = 2;
  return 1;
}

__attribute__((visibility("default"), used)) const char* glXGetClientString(void*, int) {
  return "";
}

} // extern "C"

namespace scarp::render {

namespace {

class OsmesaFactory : public vtkObjectFactory {
 public:
  static OsmesaFactory* New() { return new OsmesaFactory; }
  const char* GetVTKSourceVersion() override { return VTK_SOURCE_VERSION; }
  const char* GetDescription() override { return "scarp's OSMesa render window"; }

 protected:
  OsmesaFactory() {
    RegisterOverride("vtkRenderWindow", "OsmesaWindow", "OSMesa render window", 1,
                     []() -> vtkObject* { return OsmesaWindow::New(); });
  }
};

} // namespace

vtkStandardNewMacro(OsmesaWindow);

OsmesaWindow::OsmesaWindow() {
  ShowWindow = false;
  UseOffScreenBuffers = true;
  ScreenSize[0] = 16384;
  ScreenSize[1] = 16384;
}

OsmesaWindow::~OsmesaWindow() {
  OsmesaWindow::Finalize();
  vtkCollectionSimpleIterator iterator = nullptr;
  Renderers->InitTraversal(iterator);
  while (vtkRenderer* renderer = Renderers->GetNextRenderer(iterator))
    renderer->SetRenderWindow(nullptr);
}

void OsmesaWindow::CreateAWindow() {
  const std::array<int, 15> attributes = {OSMESA_FORMAT,
                                          OSMESA_RGBA,
                                          OSMESA_DEPTH_BITS,
                                          24,
                                          OSMESA_STENCIL_BITS,
                                          0,
                                          OSMESA_ACCUM_BITS,
                                          0,
                                          OSMESA_PROFILE,
                                          OSMESA_CORE_PROFILE,
                                          OSMESA_CONTEXT_MAJOR_VERSION,
                                          3,
                                          OSMESA_CONTEXT_MINOR_VERSION,
                                          2,
                                          0};
  context_ = OSMesaCreateContextAttribs(attributes.data(), nullptr);
  if (context_ == nullptr)
    throw std::runtime_error("cannot draw: OSMesa gives no OpenGL 3.2 core context; install "
                             "Mesa's software renderer (apt-get install libosmesa6)");
  DoubleBuffer = 0;
  Mapped = 0;
  OwnContext = 1;
  MakeCurrent();
  if (glGetString(GL_VERSION) == nullptr) {
    OSMesaDestroyContext(static_cast<OSMesaContext>(context_));
    context_ = nullptr;
    throw std::runtime_error("cannot draw: this program finds libGL's functions before those of "
                             "libOSMesa; install libosmesa6 and link OSMesa first");
  }
  OpenGLInit();
  if (!Initialized) // VTK would go on and call null pointers
    throw std::runtime_error("cannot draw: VTK could not load OpenGL from OSMesa; install a "
                             "matching libosmesa6 and libvtk9.1");
}

void OsmesaWindow::DestroyWindow() {
  if (context_ != nullptr) {
    MakeCurrent();
    ReleaseGraphicsResources(this);
    OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
    OSMesaDestroyContext(static_cast<OSMesaContext>(context_));
    context_ = nullptr;
  }
  delete[] Capabilities;
  Capabilities = nullptr;
}

void OsmesaWindow::Initialize() {
  if (context_ == nullptr) {
    CreateAWindow();
  } else if (!Initialized) { // after ReleaseGraphicsResources()
    MakeCurrent();
    OpenGLInit();
  }
}

void OsmesaWindow::Finalize() { DestroyWindow(); }

void OsmesaWindow::MakeCurrent() {
  if (context_ == nullptr || IsCurrent()) return;
  if (!OSMesaMakeCurrent(static_cast<OSMesaContext>(context_), buffer_.data(), GL_UNSIGNED_BYTE,
                         static_cast<int>(buffer_side), static_cast<int>(buffer_side)))
    vtkErrorMacro("OSMesaMakeCurrent failed");
}

bool OsmesaWindow::IsCurrent() {
  return context_ != nullptr && OSMesaGetCurrentContext() == context_;
}

void OsmesaWindow::Frame() {
  MakeCurrent();
  vtkOpenGLRenderWindow::Frame();
}

int OsmesaWindow::SupportsOpenGL() {
  Initialize();
  return context_ != nullptr && Initialized ? 1 : 0;
}

void OsmesaWindow::install_as_default() {
  static const bool installed = [] {
    vtkObjectFactory::GetRegisteredFactories()->InitTraversal(); // makes the list if there is none
    vtkObjectFactory::SetAllEnableFlags(0, "vtkRenderWindow");
    vtkObjectFactory::SetAllEnableFlags(0, "vtkRenderWindowInteractor");
    OsmesaFactory* const factory = OsmesaFactory::New();
    vtkObjectFactory::RegisterFactory(factory);
    factory->Delete();
    return true;
  }();
  static_cast<void>(installed);
}

} // namespace scarp::render
