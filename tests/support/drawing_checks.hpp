// What a drawing says and shows, looked at as data.
#pragma once

#include "render/drawing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace scarp::test {

inline bool says(const render::Drawing& drawing, const std::string& text) {
  return std::any_of(drawing.texts.begin(), drawing.texts.end(),
                     [&](const render::Words& words) { return words.text == text; });
}

/// The words that read `text`; fails and returns none of the drawing's if there are none.
inline render::Words words_of(const render::Drawing& drawing, const std::string& text) {
  for (const render::Words& words : drawing.texts)
    if (words.text == text) return words;
  ADD_FAILURE() << "the drawing does not say " << text;
  return {};
}

/// Every word lies within the picture.
inline void expect_nothing_clipped(const render::Drawing& drawing) {
  for (const render::Words& words : drawing.texts) {
    const render::Box box = covered(words);
    EXPECT_GE(box.lower.x, 0.0) << words.text;
    EXPECT_GE(box.lower.y, 0.0) << words.text;
    EXPECT_LE(box.upper.x, drawing.width) << words.text;
    EXPECT_LE(box.upper.y, drawing.height) << words.text;
  }
}

/// No words cover others.
inline void expect_words_apart(const render::Drawing& drawing) {
  for (std::size_t i = 0; i < drawing.texts.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const render::Box a = covered(drawing.texts[i]);
      const render::Box b = covered(drawing.texts[j]);
      const bool apart = a.upper.x <= b.lower.x || b.upper.x <= a.lower.x ||
                         a.upper.y <= b.lower.y || b.upper.y <= a.lower.y;
      EXPECT_TRUE(apart) << drawing.texts[i].text << " and " << drawing.texts[j].text;
    }
  }
}

/// The box around all that has the colour; empty if nothing has it.
inline render::Box extent_of(const render::Drawing& drawing, render::Colour colour) {
  render::Polyline corners;
  for (std::size_t triangle = 0; triangle < drawing.colours.size(); ++triangle)
    if (drawing.colours[triangle] == colour)
      for (std::size_t corner = 6 * triangle; corner < 6 * triangle + 6; corner += 2)
        corners.push_back({drawing.corners[corner], drawing.corners[corner + 1]});
  return render::bounds(corners);
}

/// px2, of all that has the colour, whether covered or not.
inline double area_of(const render::Drawing& drawing, render::Colour colour) {
  double area = 0.0;
  for (std::size_t triangle = 0; triangle < drawing.colours.size(); ++triangle) {
    if (drawing.colours[triangle] != colour) continue;
    const float* const c = drawing.corners.data() + 6 * triangle;
    area += 0.5 * std::abs((c[2] - c[0]) * (c[5] - c[1]) - (c[3] - c[1]) * (c[4] - c[0]));
  }
  return area;
}

} // namespace scarp::test
