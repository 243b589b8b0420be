// Pictures against baselines: EXPECT_TRUE(matches_baseline(image, "name")).
#pragma once

#include "render/image.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace scarp::test {

/// Parts of full scale, 0...1.
struct ImageDifference {
  bool same_size = true;
  double worst_tile = 0.0; ///< the largest mean absolute difference of an 8 x 8 pixel tile
  double mean = 0.0;       ///< over all pixels
};

/// Pictures of different size differ fully.
ImageDifference difference(const render::Image& a, const render::Image& b);

/// Between harmless changes (other antialiasing 0.037, shifted by 1 px 0.044) and defects (shifted
/// by 2 px 0.087, 11 colours for 12 0.092, another range 0.26, another word 0.31).
inline constexpr double worst_tile_allowed = 0.06;

struct BaselinePlaces {
  std::filesystem::path baselines; ///< NAME.png
  std::filesystem::path results;   ///< NAME.actual.png and NAME.diff.png
  bool update = false;             ///< write the picture as the baseline, and still fail
};

/// The project's folders; `update` is the environment variable SCARP_UPDATE_BASELINES=1.
BaselinePlaces project_baselines();

/// Fails if there is no baseline or the picture differs from it; the message says by how much,
/// where the pictures are, and how to accept the new one.
testing::AssertionResult matches_baseline(const render::Image& image, const std::string& name,
                                          const BaselinePlaces& places = project_baselines());

} // namespace scarp::test
