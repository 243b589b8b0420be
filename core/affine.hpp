// Weights of affine transfers (APIC): v(x) = v_p + C_p (x - x_p) around a point.
#pragma once

#include "core/particles.hpp"
#include "core/stencil.hpp"

#include <algorithm>
#include <limits>

namespace scarp {

/// With r_I = x_I - x_p: C_p = sum_I v_I (x) q_I, q_I = N_I D_p^-1 r_I, D_p = sum_I N_I r_I (x) r_I
/// (Jiang et al. 2015, doi 10.1145/2766996), which is diagonal for products of functions that
/// reproduce linear ones.  Linear functions give q_I = grad N_I, B-splines D_p = h^2/4 I.
template <int Dim, class Shape> struct AffineWeights {
  typename Shape::Along r; ///< m, by axis and place
  typename Shape::Along q; ///< 1/m, of the axis alone

  AffineWeights(const Shape& shape, const Vec<Dim>& xi, const StencilCell<Dim>& cell) {
    for (std::size_t a = 0; a < Dim; ++a) {
      Real D = 0.0;
      for (std::size_t k = 0; k < Shape::width; ++k) {
        r[a][k] = (Shape::positions[k] - xi[a]) * cell.h;
        D += shape.w[a][k] * r[a][k] * r[a][k];
      }
      const Real inv_D = 1.0 / std::max(D, std::numeric_limits<Real>::min());
      for (std::size_t k = 0; k < Shape::width; ++k)
        q[a][k] = Shape::layout == NodeLayout::corner ? (k == 0 ? -cell.inv_h : cell.inv_h)
                                                      : shape.w[a][k] * r[a][k] * inv_D;
    }
  }
};

/// mv_I += m_p C_p r_I N_I
template <int Dim, class Shape>
void add_affine_momentum(std::array<std::array<Real, Shape::nodes>, Dim>& mv,
                         const Particles<Dim>& points, const Shape& shape, const Vec<Dim>& xi,
                         const StencilCell<Dim>& cell, std::size_t p) {
  const AffineWeights<Dim, Shape> weights(shape, xi, cell);
  const Real m = points.mass(p);
  for (std::size_t c = 0; c < Shape::nodes; ++c) {
    const auto k = Shape::places(c);
    for (std::size_t i = 0; i < Dim; ++i)
      for (std::size_t j = 0; j < Dim; ++j)
        mv[i][c] += m * points.C[Dim * i + j][p] * weights.r[j][k[j]] * shape.N[c];
  }
}

/// C_p = sum_I v_I (x) q_I
template <int Dim, class Shape>
void gather_affine(Particles<Dim>& points, const std::array<Vec<Dim>, Shape::nodes>& v_I,
                   const Shape& shape, const Vec<Dim>& xi, const StencilCell<Dim>& cell,
                   std::size_t p) {
  const AffineWeights<Dim, Shape> weights(shape, xi, cell);
  std::array<Vec<Dim>, Shape::nodes> q;
  for (std::size_t c = 0; c < Shape::nodes; ++c) {
    const auto k = Shape::places(c);
    for (std::size_t a = 0; a < Dim; ++a) {
      q[c][a] = weights.q[a][k[a]];
      for (std::size_t b = 0; b < Dim; ++b)
        if (b != a) q[c][a] *= shape.w[b][k[b]];
    }
  }
  for (std::size_t i = 0; i < Dim; ++i)
    for (std::size_t j = 0; j < Dim; ++j) {
      Real sum = 0.0;
      for (std::size_t c = 0; c < Shape::nodes; ++c) sum += v_I[c][i] * q[c][j];
      points.C[Dim * i + j][p] = sum;
    }
}

} // namespace scarp
