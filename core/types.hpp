// Numbers, vectors and symmetric tensors, with the sign and component conventions of the whole
// core.
//
// Signs: tension and extension are positive; mean stress = tr(sigma)/3, negative in compression.
// Units: SI throughout.  In plane strain everything extensive (mass, volume, force, energy) is per
// metre of depth.
//
// Axes of Vec<2>: x, z.  Axes of Vec<3>: x, y, z.  The last axis is the vertical one.
#pragma once

#include <array>
#include <cstddef>

namespace scarp {

/// Of everything that does not depend on Precision: time, positions, walls, energies.  The passes
/// are templates of their number T, which is this or float.
using Real = double;

template <int Dim, class T = Real> using Vec = std::array<T, Dim>;

/// grad[i][j] = d v_i / d x_j
template <int Dim, class T = Real> using Mat = std::array<std::array<T, Dim>, Dim>;

/// Components of a symmetric tensor.  The three normal components always come first, so that
/// invariants are three-dimensional in plane strain as well:
///   Dim 2: xx, zz, yy (out of plane), xz
///   Dim 3: xx, yy, zz, xy, yz, xz
template <int Dim> inline constexpr int tensor_size = Dim == 2 ? 4 : 6;
template <int Dim, class T = Real> using SymTensor = std::array<T, tensor_size<Dim>>;

/// Index in SymTensor<Dim> of component (i, j) of the computed axes.
template <int Dim> constexpr std::size_t component(int i, int j) {
  if (i == j) return static_cast<std::size_t>(i);
  if constexpr (Dim == 2) return 3;
  return static_cast<std::size_t>(i + j == 1 ? 3 : i + j == 3 ? 4 : 5);
}

template <int Dim, class T> constexpr T trace(const SymTensor<Dim, T>& a) {
  return a[0] + a[1] + a[2];
}

} // namespace scarp
