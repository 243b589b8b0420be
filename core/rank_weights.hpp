// Shape functions at the points of a rank, one in each lane, and what such points give to nodes.
#pragma once

#include "core/lanes.hpp"
#include "core/stencil.hpp"

namespace scarp {

/// Functions at one point in each cell of a tile, kept as products: along x, and for each line of a
/// cell's nodes what the other axes give.  Node c = line * width + k.
template <int Dim, class Shape> struct RankWeights {
  using T = typename Shape::Number;
  static constexpr std::size_t width = Shape::width;
  static constexpr std::size_t lines = Shape::nodes / width;
  using Along = AlongAxes<Dim, Shape::width, Pack<T>>;

  Along along;
  std::array<Pack<T>, lines> w;                       ///< product of the functions
  std::array<std::array<Pack<T>, lines>, Dim - 1> dw; ///< the derivative along y (or z), z

  [[gnu::always_inline]] RankWeights(const std::array<Pack<T>, Dim>& xi,
                                     const StencilCell<Dim>& cell)
      : along(Shape::along(xi, cell)) {
    repeated<lines>([&](std::size_t line) __attribute__((always_inline)) {
      if constexpr (Dim == 2) {
        w[line] = along.w[1][line];
        dw[0][line] = along.dw[1][line];
      } else {
        const std::size_t y = line % width, z = line / width;
        w[line] = along.w[1][y] * along.w[2][z];
        dw[0][line] = along.dw[1][y] * along.w[2][z];
        dw[1][line] = along.w[1][y] * along.dw[2][z];
      }
    });
  }
};

/// Adds what a rank gives: value N_c.
template <int Dim, class Shape, class T = typename Shape::Number>
[[gnu::always_inline]] inline void add_values(std::array<Pack<T>, Shape::nodes>& sums,
                                              const RankWeights<Dim, Shape>& weights,
                                              const Pack<T>& value) {
  repeated<RankWeights<Dim, Shape>::lines>([&](std::size_t line) __attribute__((always_inline)) {
    const Pack<T> on_line = weights.w[line] * value;
    unrolled<Shape::width>([&](auto k) __attribute__((always_inline)) {
      sums[line * Shape::width + k] += weights.along.w[0][k] * on_line;
    });
  });
}

/// Takes away sum_j V_tau_ij dN_c / dx_j.
template <int Dim, class Shape, class T = typename Shape::Number>
[[gnu::always_inline]] inline void add_forces(std::array<std::array<Pack<T>, Shape::nodes>, Dim>& f,
                                              const RankWeights<Dim, Shape>& weights,
                                              const SymTensor<Dim, Pack<T>>& V_tau) {
  constexpr std::size_t width = Shape::width;
  const auto stress = [&](std::size_t i, std::size_t j) __attribute__((always_inline)) {
    return V_tau[component<Dim>(static_cast<int>(i), static_cast<int>(j))];
  };
  repeated<RankWeights<Dim, Shape>::lines>([&](std::size_t line) __attribute__((always_inline)) {
    unrolled<Dim>([&](auto i) __attribute__((always_inline)) {
      const Pack<T> along_x = stress(i, 0) * weights.w[line];
      Pack<T> across = stress(i, 1) * weights.dw[0][line];
      if constexpr (Dim == 3) across += stress(i, 2) * weights.dw[1][line];
      unrolled<width>([&](auto k) __attribute__((always_inline)) {
        f[i][line * width + k] -= weights.along.dw[0][k] * along_x;
        f[i][line * width + k] -= weights.along.w[0][k] * across;
      });
    });
  });
}

/// Adds m N_c v, or for affine transfers m N_c (v + C r_c), with m_v and m_C[Dim i + j] = m C_ij.
template <int Dim, class Shape, bool affine, class T = typename Shape::Number>
[[gnu::always_inline]] inline void
add_momenta(std::array<std::array<Pack<T>, Shape::nodes>, Dim>& mv,
            const RankWeights<Dim, Shape>& weights, const std::array<Pack<T>, Dim>& xi,
            const std::array<Pack<T>, Dim>& m_v,
            const std::array<Pack<T>, static_cast<std::size_t>(Dim) * Dim>& m_C, Real h) {
  if constexpr (!affine) {
    unrolled<Dim>([&](auto i) __attribute__((always_inline)) {
      add_values<Dim, Shape>(mv[i], weights, m_v[i]);
    });
  } else {
    constexpr std::size_t width = Shape::width;
    std::array<std::array<Pack<T>, width>, Dim> r;
    unrolled<Dim>([&](auto a) __attribute__((always_inline)) {
      unrolled<width>([&](auto k) __attribute__((always_inline)) {
        r[a][k] = (number<T>(Shape::positions[k]) - xi[a]) * number<T>(h);
      });
    });
    repeated<RankWeights<Dim, Shape>::lines>([&](std::size_t line) __attribute__((always_inline)) {
      unrolled<Dim>([&](auto i) __attribute__((always_inline)) {
        Pack<T> on_line = m_v[i] + m_C[Dim * i + 1] * r[1][line % width];
        if constexpr (Dim == 3) on_line += m_C[Dim * i + 2] * r[2][line / width];
        on_line *= weights.w[line];
        const Pack<T> along_x = m_C[Dim * i] * weights.w[line];
        unrolled<width>([&](auto k) __attribute__((always_inline)) {
          mv[i][line * width + k] += weights.along.w[0][k] * (on_line + along_x * r[0][k]);
        });
      });
    });
  }
}

/// q_I along each axis (core/affine.hpp), instead of derivatives.
template <int Dim, class Shape, class T>
[[gnu::always_inline]] inline auto affine_functions(const std::array<T, Dim>& xi,
                                                    const AlongAxes<Dim, Shape::width, T>& along,
                                                    const StencilCell<Dim>& cell) {
  if constexpr (Shape::layout == NodeLayout::corner) {
    return along.dw;
  } else {
    auto q = along.w;
    unrolled<Dim>([&](auto a) __attribute__((always_inline)) {
      std::array<T, Shape::width> r; // in cells
      T D = 0.0F;
      unrolled<Shape::width>([&](auto k) __attribute__((always_inline)) {
        r[k] = number<T>(Shape::positions[k]) - xi[a];
        D += along.w[a][k] * r[k] * r[k];
      });
      T inv_D_h = number<T>(cell.inv_h) / D;
      if constexpr (requires { Shape::inertia; }) inv_D_h = number<T>(cell.inv_h / Shape::inertia);
      for (std::size_t k = 0; k < Shape::width; ++k) q[a][k] *= r[k] * inv_D_h;
    });
    return q;
  }
}

} // namespace scarp
