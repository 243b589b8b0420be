// Linear (bilinear, trilinear) shape functions of a cell's corners.
#pragma once

#include "core/types.hpp"

namespace scarp {

/// N and grad N (1/m) of the 2^Dim corners at xi in [0, 1]^Dim; bit a of a corner's number says
/// which side along axis a it lies on.
template <int Dim> struct LinearShape {
  static constexpr int nodes = 1 << Dim;
  std::array<Real, nodes> N;
  std::array<Vec<Dim>, nodes> dN;

  LinearShape(const Vec<Dim>& xi, Real inv_h) {
    std::array<std::array<Real, 2>, Dim> w;
    for (std::size_t a = 0; a < Dim; ++a) w[a] = {1.0 - xi[a], xi[a]};
    for (std::size_t c = 0; c < nodes; ++c) {
      Real product = 1.0;
      for (std::size_t a = 0; a < Dim; ++a) product *= w[a][c >> a & 1];
      N[c] = product;
      for (std::size_t a = 0; a < Dim; ++a) {
        Real slope = (c >> a & 1) ? inv_h : -inv_h;
        for (std::size_t b = 0; b < Dim; ++b)
          if (b != a) slope *= w[b][c >> b & 1];
        dN[c][a] = slope;
      }
    }
  }
};

} // namespace scarp
