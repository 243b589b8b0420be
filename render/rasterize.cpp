#include "render/drawing.hpp"

#include "render/vtk_errors.hpp"
#include "render/vtk_window.hpp"

#include <vtkCellArray.h>
#include <vtkContext2D.h>
#include <vtkContextActor.h>
#include <vtkContextItem.h>
#include <vtkContextScene.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkMapper.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

namespace scarp::render {

namespace {

// Debian's fontconfig brings DejaVu; VTK's own font, the fallback, lacks letters such as phi.
const char* font_file(bool bold) {
  static const std::string folder = "/usr/share/fonts/truetype/dejavu/";
  static const std::string regular = folder + "DejaVuSans.ttf";
  static const std::string heavy = folder + "DejaVuSans-Bold.ttf";
  static const bool installed = std::filesystem::exists(regular) && std::filesystem::exists(heavy);
  if (!installed) return nullptr;
  return bold ? heavy.c_str() : regular.c_str();
}

void set_font(const Words& words, vtkTextProperty& property) {
  const char* const file = font_file(words.bold);
  if (file != nullptr) {
    property.SetFontFamily(VTK_FONT_FILE);
    property.SetFontFile(file);
  } else {
    property.SetFontFamilyToArial();
    property.SetBold(words.bold ? 1 : 0);
  }
  property.SetFontSize(static_cast<int>(std::lround(words.size)));
  property.SetItalic(0);
  property.SetShadow(0);
  property.SetColor(words.colour.red / 255.0, words.colour.green / 255.0,
                    words.colour.blue / 255.0);
}

/// Paints one drawing; lent, not owned.
class DrawingItem : public vtkContextItem {
 public:
  static DrawingItem* New();
  DrawingItem(const DrawingItem&) = delete;
  DrawingItem& operator=(const DrawingItem&) = delete;

  void show(const Drawing& drawing) {
    drawing_ = &drawing;
    const auto triangles = static_cast<vtkIdType>(drawing.colours.size());
    vtkNew<vtkFloatArray> coordinates;
    coordinates->SetNumberOfComponents(3);
    coordinates->SetNumberOfTuples(3 * triangles);
    vtkNew<vtkIdTypeArray> corners;
    corners->SetNumberOfValues(3 * triangles);
    colours_->SetNumberOfComponents(4);
    colours_->SetNumberOfTuples(triangles);
    float* coordinate = coordinates->GetPointer(0);
    for (vtkIdType corner = 0; corner < 3 * triangles; ++corner) {
      const auto at = 2 * static_cast<std::size_t>(corner);
      *coordinate++ = drawing.corners[at];
      *coordinate++ = drawing.corners[at + 1];
      *coordinate++ = 0.0F;
      corners->SetValue(corner, corner);
    }
    unsigned char* channel = colours_->GetPointer(0);
    for (const Colour colour : drawing.colours) {
      *channel++ = colour.red;
      *channel++ = colour.green;
      *channel++ = colour.blue;
      *channel++ = 255;
    }
    vtkNew<vtkPoints> points;
    points->SetData(coordinates);
    vtkNew<vtkCellArray> cells;
    cells->SetData(3, corners);
    shapes_->SetPoints(points);
    shapes_->SetPolys(cells);
  }

  bool Paint(vtkContext2D* painter) override {
    if (!drawing_->backdrop.rgb.empty()) paint_backdrop(*painter);
    if (!drawing_->colours.empty())
      painter->DrawPolyData(0.0F, 0.0F, shapes_, colours_, VTK_SCALAR_MODE_USE_CELL_DATA);
    for (const Words& words : drawing_->texts) paint_words(*painter, words);
    return true;
  }

 protected:
  DrawingItem() = default;

 private:
  void paint_backdrop(vtkContext2D& painter) const {
    const Image& image = drawing_->backdrop;
    vtkNew<vtkImageData> data;
    data->SetDimensions(image.width, image.height, 1);
    data->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    const std::size_t bytes = 3 * static_cast<std::size_t>(image.width);
    for (int row = 0; row < image.height; ++row) {
      const auto from = static_cast<std::size_t>(image.height - 1 - row) * bytes;
      std::copy_n(image.rgb.data() + from, bytes,
                  static_cast<unsigned char*>(data->GetScalarPointer(0, row, 0)));
    }
    painter.DrawImage(0.0F, 0.0F, data);
  }

  static void paint_words(vtkContext2D& painter, const Words& words) {
    vtkTextProperty& property = *painter.GetTextProp();
    set_font(words, property);
    property.SetOrientation(words.upright ? 90.0 : 0.0);
    // VTK aligns along the text: turned by 90 degrees that is upwards, and across is to the left.
    const auto along = static_cast<int>(words.horizontal);
    const auto across = static_cast<int>(words.vertical);
    property.SetJustification(words.upright ? across : along);
    property.SetVerticalJustification(words.upright ? 2 - along : across);
    painter.DrawString(static_cast<float>(std::round(words.position.x)),
                       static_cast<float>(std::round(words.position.y)), words.text.c_str());
  }

  const Drawing* drawing_ = nullptr;
  vtkNew<vtkPolyData> shapes_;
  vtkNew<vtkUnsignedCharArray> colours_;
};

vtkStandardNewMacro(DrawingItem);

} // namespace

Point text_size(const Words& words) {
  vtkNew<vtkTextProperty> property;
  set_font(words, *property);
  int box[4] = {0, 0, 0, 0}; // VTK's interface
  constexpr int dots_per_inch = 72;
  vtkTextRenderer::GetInstance()->GetBoundingBox(property, words.text, box, dots_per_inch);
  return {box[1] - box[0] + 1.0, box[3] - box[2] + 1.0};
}

Image rasterize(const Drawing& drawing) {
  VtkErrors errors;
  vtkNew<vtkContextActor> actor;
  vtkNew<DrawingItem> item;
  item->show(drawing);
  actor->GetScene()->AddItem(item);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  renderer->AddActor(actor);
  Image image = draw(*renderer, drawing.width, drawing.height);
  errors.check("drawing a figure");
  return image;
}

} // namespace scarp::render
