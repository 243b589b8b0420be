// Registers that hold a number for each cell of a tile (core/cell_order.hpp): the lanes of all
// passes over points.
#pragma once

#include "core/particles.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <experimental/simd>
#include <type_traits>
#include <utility>

namespace scarp {

/// Cells that a pass works on at once: as many as a register has lanes, with AVX-512 8 of doubles
/// and 16 of floats, half of these with AVX2.
template <class T>
inline constexpr std::size_t tile_cells = std::experimental::native_simd<T>::size();

/// Several numbers in the lanes of one register, or of two.
template <class T, std::size_t count>
using Lanes =
    std::experimental::simd<T, std::experimental::simd_abi::deduce_t<T, static_cast<int>(count)>>;

/// A number for each cell of a tile, or for a point in each.
template <class T> using Pack = Lanes<T, tile_cells<T>>;

/// The number type of a number, or of a Pack's lanes.
template <class T> struct NumberIn { using type = T; };
template <class T, class Abi> struct NumberIn<std::experimental::simd<T, Abi>> { using type = T; };
/// A constant in the number type of T.
template <class T> constexpr auto number(Real value) {
  return static_cast<typename NumberIn<T>::type>(value);
}

template <class T> [[gnu::always_inline]] inline Pack<T> load_lanes(const T* from) {
  return Pack<T>(from, std::experimental::element_aligned);
}
template <class T>
[[gnu::always_inline]] inline void store_lanes(const std::type_identity_t<Pack<T>>& values, T* to) {
  values.copy_to(to, std::experimental::element_aligned);
}
/// The same for the first lanes only.
template <class T>
[[gnu::always_inline]] inline void store_lanes(const std::type_identity_t<Pack<T>>& values, T* to,
                                               std::size_t count) {
  if (count == tile_cells<T>) return store_lanes(values, to);
  for (std::size_t lane = 0; lane < count; ++lane) to[lane] = values[lane];
}

/// 0, 1, 2, ...
template <class T, std::size_t count = tile_cells<T>>
[[gnu::always_inline]] inline Lanes<T, count> lane_numbers() {
  return Lanes<T, count>([](auto lane) { return static_cast<T>(static_cast<int>(lane)); });
}

/// The first lanes; 0 in the others, for which nothing is read.
template <std::size_t count, class T>
[[gnu::always_inline]] inline Pack<T> load_first(const T* from) {
  Pack<T> lanes = T(0);
  where(lane_numbers<T>() < static_cast<T>(count), lanes)
      .copy_from(from, std::experimental::element_aligned);
  return lanes;
}

/// The lanes moved up by k, with those of `below` behind them.
template <std::size_t k, class T>
[[gnu::always_inline]] inline Pack<T> moved_up(const Pack<T>& lanes, const Pack<T>& below) {
  constexpr std::size_t cells = tile_cells<T>;
  typedef T Vector [[gnu::vector_size(cells * sizeof(T))]];
  if constexpr (std::is_trivially_copyable_v<Pack<T>> && sizeof(Pack<T>) == sizeof(Vector)) {
    return [&]<std::size_t... lane>(std::index_sequence<lane...>) __attribute__((always_inline)) {
      return std::bit_cast<Pack<T>>(__builtin_shufflevector(std::bit_cast<Vector>(below),
                                                            std::bit_cast<Vector>(lanes),
                                                            static_cast<int>(cells - k + lane)...));
    }
    (std::make_index_sequence<cells>());
  } else { // in several registers
    std::array<T, 2 * cells> both;
    store_lanes(below, both.data());
    store_lanes(lanes, &both[cells]);
    return load_lanes(&both[cells - k]);
  }
}

// The lambdas of the passes are always_inline: GCC takes the larger ones out of line, and all
// registers with them through memory.

/// Calls visit(0) ... visit(n - 1) with compile-time numbers, so that what they index stays in
/// registers.
template <std::size_t n, class Visit> [[gnu::always_inline]] inline void unrolled(Visit&& visit) {
  [&]<std::size_t... k>(std::index_sequence<k...>) __attribute__((always_inline)) {
    (visit(std::integral_constant<std::size_t, k>()), ...);
  }
  (std::make_index_sequence<n>());
}

/// The same, or a loop if n is many: what they index does not fit into registers then.
template <std::size_t n, class Visit> [[gnu::always_inline]] inline void repeated(Visit&& visit) {
  if constexpr (n <= 4)
    unrolled<n>(visit);
  else
    for (std::size_t k = 0; k < n; ++k) visit(k);
}

/// Calls visit(a constant) with the flag, so that a pass has no branch on it inside.
template <class Visit> auto with_flag(bool flag, Visit&& visit) {
  return flag ? visit(std::true_type()) : visit(std::false_type());
}

} // namespace scarp
