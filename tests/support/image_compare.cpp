#include "tests/support/image_compare.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>

namespace scarp::test {

namespace {

constexpr double full_scale = 255.0;

double pixel_difference(const render::Image& a, const render::Image& b, int x, int y) {
  const auto at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(a.width) +
                       static_cast<std::size_t>(x));
  double sum = 0.0;
  for (std::size_t channel = 0; channel < 3; ++channel)
    sum += std::abs(a.rgb[at + channel] - b.rgb[at + channel]);
  return sum / (3.0 * full_scale);
}

/// White where the pictures agree, darker where they differ; the smallest differences can be seen.
render::Image difference_image(const render::Image& a, const render::Image& b) {
  render::Image image = {a.width, a.height, {}};
  constexpr double strength = 3.0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const double dark = std::min(1.0, strength * pixel_difference(a, b, x, y));
      const auto grey = static_cast<unsigned char>(full_scale * (1.0 - dark));
      image.rgb.insert(image.rgb.end(), 3, grey);
    }
  }
  return image;
}

} // namespace

ImageDifference difference(const render::Image& a, const render::Image& b) {
  if (a.width != b.width || a.height != b.height) return {false, 1.0, 1.0};
  ImageDifference found;
  double total = 0.0;
  constexpr int side = 8;
  for (int top = 0; top < a.height; top += side) {
    for (int left = 0; left < a.width; left += side) {
      double sum = 0.0;
      int count = 0;
      for (int y = top; y < std::min(top + side, a.height); ++y) {
        for (int x = left; x < std::min(left + side, a.width); ++x) {
          sum += pixel_difference(a, b, x, y);
          ++count;
        }
      }
      found.worst_tile = std::max(found.worst_tile, sum / count);
      total += sum;
    }
  }
  found.mean = total / (static_cast<double>(a.width) * a.height);
  return found;
}

BaselinePlaces project_baselines() {
  const char* const update = std::getenv("SCARP_UPDATE_BASELINES");
  return {SCARP_BASELINE_DIR, SCARP_IMAGE_RESULT_DIR,
          update != nullptr && std::string(update) == "1"};
}

testing::AssertionResult matches_baseline(const render::Image& image, const std::string& name,
                                          const BaselinePlaces& places) {
  const std::filesystem::path baseline = places.baselines / (name + ".png");
  const std::filesystem::path actual = places.results / (name + ".actual.png");
  std::filesystem::create_directories(places.results);
  if (places.update) {
    std::filesystem::create_directories(places.baselines);
    render::write_png(baseline, image);
    return testing::AssertionFailure()
           << "baseline written, look at it: " << baseline.string()
           << "\n(the test fails as long as SCARP_UPDATE_BASELINES is set)";
  }
  const std::string accept =
      "\nto accept the new picture: cp " + actual.string() + " " + baseline.string();
  if (!std::filesystem::exists(baseline)) {
    render::write_png(actual, image);
    return testing::AssertionFailure() << "there is no baseline " << baseline.string() << accept;
  }
  const render::Image expected = render::read_png(baseline);
  const ImageDifference found = difference(image, expected);
  if (found.same_size && found.worst_tile <= worst_tile_allowed) return testing::AssertionSuccess();

  render::write_png(actual, image);
  testing::AssertionResult failure = testing::AssertionFailure();
  if (!found.same_size)
    return failure << name << " is " << image.width << " x " << image.height << " px, its baseline "
                   << expected.width << " x " << expected.height << " px" << accept;
  const std::filesystem::path diff = places.results / (name + ".diff.png");
  render::write_png(diff, difference_image(image, expected));
  return failure << name << " differs from its baseline: worst tile " << found.worst_tile
                 << " (allowed " << worst_tile_allowed << "), mean " << found.mean
                 << "\ndifference: " << diff.string() << accept;
}

} // namespace scarp::test
