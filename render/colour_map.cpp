#include "render/colour_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace scarp::render {

namespace {

constexpr std::size_t anchor_count = 9;
using Anchors = std::array<Colour, anchor_count>; // evenly spaced

constexpr Anchors viridis = {{{68, 1, 84},
                              {71, 44, 122},
                              {59, 81, 139},
                              {44, 113, 142},
                              {33, 144, 141},
                              {39, 173, 129},
                              {92, 200, 99},
                              {170, 220, 50},
                              {253, 231, 37}}};

constexpr Anchors cividis = {{{0, 32, 77},
                              {0, 52, 110},
                              {57, 72, 107},
                              {87, 93, 109},
                              {112, 113, 115},
                              {138, 134, 120},
                              {166, 157, 117},
                              {198, 182, 107},
                              {255, 234, 70}}};

constexpr Anchors inferno = {{{0, 0, 4},
                              {31, 12, 72},
                              {85, 15, 109},
                              {136, 34, 106},
                              {186, 54, 85},
                              {227, 89, 51},
                              {249, 140, 10},
                              {249, 201, 50},
                              {252, 255, 164}}};

const Anchors& anchors(ColourMap map) {
  switch (map) {
  case ColourMap::viridis:
    return viridis;
  case ColourMap::cividis:
    return cividis;
  case ColourMap::inferno:
    return inferno;
  }
  throw std::invalid_argument("no such colour map");
}

} // namespace

ColourMap colour_map(const std::string& name) {
  if (name == "viridis") return ColourMap::viridis;
  if (name == "cividis") return ColourMap::cividis;
  if (name == "inferno") return ColourMap::inferno;
  throw std::invalid_argument("no colour map '" + name + "'; there are: viridis, cividis, inferno");
}

Colour colour_at(ColourMap map, double part) {
  const Anchors& table = anchors(map);
  const double place = std::clamp(part, 0.0, 1.0) * static_cast<double>(anchor_count - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(place), anchor_count - 2);
  return mixed(table[below], table[below + 1], place - static_cast<double>(below));
}

std::vector<Colour> band_colours(ColourMap map, int count) {
  std::vector<Colour> colours;
  colours.reserve(static_cast<std::size_t>(count));
  for (int band = 0; band < count; ++band)
    colours.push_back(colour_at(map, count > 1 ? static_cast<double>(band) / (count - 1) : 0.5));
  return colours;
}

} // namespace scarp::render
