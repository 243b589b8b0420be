// A VTK render window on an OSMesa (software Mesa) context: no X server, DISPLAY, GPU or EGL.
// Internal to render: it includes VTK, so only .cpp files may include it.
#pragma once

#include <vtkOpenGLRenderWindow.h>

#include <array>
#include <cstddef>

namespace scarp::render {

/// Off-screen only; VTK draws into its own framebuffer objects, so the size may change freely.
/// Initialize(), and so the first Render(), throws std::runtime_error when there is no context.
class OsmesaWindow : public vtkOpenGLRenderWindow {
 public:
  static OsmesaWindow* New();
  OsmesaWindow(const OsmesaWindow&) = delete;
  OsmesaWindow& operator=(const OsmesaWindow&) = delete;

  /// Makes vtkRenderWindow::New() return this class and disables the X11 classes, which abort
  /// the process when there is no display.  Cheap to call again.
  static void install_as_default();

  void Initialize() override;
  void Finalize() override;
  void MakeCurrent() override;
  bool IsCurrent() override;
  void Frame() override;
  int SupportsOpenGL() override;
  vtkTypeBool IsDirect() override { return 0; }
  vtkTypeBool GetEventPending() override { return 0; }
  void* GetGenericContext() override { return context_; }
  void* GetGenericDisplayId() override { return nullptr; }
  void* GetGenericWindowId() override { return nullptr; }
  void* GetGenericParentId() override { return nullptr; }
  void* GetGenericDrawable() override { return nullptr; }
  int* GetScreenSize() override { return ScreenSize; }
  void SetFullScreen(vtkTypeBool) override {}
  void WindowRemap() override {}
  void HideCursor() override {}
  void ShowCursor() override {}
  void SetDisplayId(void*) override {}
  void SetWindowId(void*) override {}
  void SetParentId(void*) override {}
  void SetNextWindowId(void*) override {}
  void SetWindowInfo(const char*) override {}
  void SetNextWindowInfo(const char*) override {}
  void SetParentInfo(const char*) override {}

 protected:
  OsmesaWindow();
  ~OsmesaWindow() override;
  void CreateAWindow() override;
  void DestroyWindow() override;

 private:
  static constexpr std::size_t buffer_side = 16; // px; never drawn to, but OSMesa wants one

  void* context_ = nullptr; // an OSMesaContext
  std::array<unsigned char, 4 * buffer_side* buffer_side> buffer_ = {};
};

} // namespace scarp::render
