// The nodes that a point reaches and its weights there: products of functions along the axes.
#pragma once

#include "core/grid_index.hpp"
#include "core/lanes.hpp"
#include "core/types.hpp"

namespace scarp {

/// What the points of a cell share in their shape functions.
template <int Dim> struct StencilCell {
  Vec<Dim> corner; ///< lowest corner, in cells from the grid's lower corner
  Real h;          ///< m
  Real inv_h;      ///< 1/m
  Real half_point; ///< half the length of a point, in cells

  StencilCell(const GridIndex<Dim>& grid, const std::array<int, Dim>& along, Real half_point_length)
      : h(grid.h), inv_h(grid.inv_h), half_point(half_point_length) {
    for (std::size_t i = 0; i < Dim; ++i) corner[i] = along[i];
  }
};

/// Functions along each axis and their derivatives, 1/m.  T is Real, or holds several points.
template <int Dim, int width, class T = Real> struct AlongAxes {
  using Values = std::array<std::array<T, width>, Dim>;
  Values w;
  Values dw;
};

/// sum_I w_I value(I) over the nodes of a cell, where w_I is the product of the functions along the
/// axes: axis after axis.
template <std::size_t axes, class T, std::size_t width, std::size_t Dim, class Value>
[[gnu::always_inline]] inline T interpolate_axes(const std::array<std::array<T, width>, Dim>& w,
                                                 const Value& value, std::size_t first) {
  const auto part = [&](std::size_t k) __attribute__((always_inline))->T {
    if constexpr (axes == 1)
      return T(value(first + k));
    else
      return interpolate_axes<axes - 1>(
          w, value,
          first + k * static_cast<std::size_t>(
                          power(static_cast<int>(width), static_cast<int>(axes) - 1)));
  };
  T sum = w[axes - 1][0] * part(0);
  for (std::size_t k = 1; k < width; ++k) sum += w[axes - 1][k] * part(k);
  return sum;
}

template <class T, std::size_t width, std::size_t Dim, class Value>
[[gnu::always_inline]] inline T interpolate(const std::array<std::array<T, width>, Dim>& w,
                                            const Value& value) {
  return interpolate_axes<Dim>(w, value, 0);
}

/// N and grad N (1/m) at the width^Dim nodes of a cell, x fastest.
template <int Dim, int width_, class T = Real> struct Stencil {
  using Number = T; ///< of the passes in lanes; at one point the functions are Real
  static constexpr int width = width_;
  static constexpr int nodes = power(width, Dim);
  using Along = typename AlongAxes<Dim, width>::Values;
  std::array<Real, nodes> N;
  std::array<Vec<Dim>, nodes> dN;
  Along w; ///< N is the product of these

 protected:
  explicit Stencil(const AlongAxes<Dim, width>& along) : w(along.w) {
    const Along& dw = along.dw;
    for (std::size_t c = 0; c < nodes; ++c) {
      const std::array<std::size_t, Dim> k = places(c);
      Real product = 1.0;
      for (std::size_t a = 0; a < Dim; ++a) product *= w[a][k[a]];
      N[c] = product;
      for (std::size_t a = 0; a < Dim; ++a) {
        Real slope = dw[a][k[a]];
        for (std::size_t b = 0; b < Dim; ++b)
          if (b != a) slope *= w[b][k[b]];
        dN[c][a] = slope;
      }
    }
  }

 public:
  /// Place of node c along each axis.
  static constexpr std::array<std::size_t, Dim> places(std::size_t c) {
    std::array<std::size_t, Dim> k = {};
    for (std::size_t a = 0; a < Dim; ++a, c /= width) k[a] = c % width;
    return k;
  }
};

} // namespace scarp
