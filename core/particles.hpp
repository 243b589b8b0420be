// The material points: all state, as structure of arrays.
#pragma once

#include "core/memory.hpp"
#include "core/types.hpp"

#include <cstdint>
#include <limits>
#include <vector>

namespace scarp {

using Column = std::vector<Real>;

/// An id that no material point has.
inline constexpr std::uint32_t no_point = std::numeric_limits<std::uint32_t>::max();

/// Row p of every column belongs to one material point.  Rows are kept sorted by cell; `id` is the
/// point's place in the order of creation and never changes.
template <int Dim> struct Particles {
  std::array<Column, Dim> x;                ///< m, position
  std::array<Column, Dim> v;                ///< m/s
  std::array<Column, Dim> dx;               ///< m, displacement of the current step
  std::array<Column, tensor_size<Dim>> tau; ///< Pa, Kirchhoff stress (see core/stress_pass.hpp)
  /// 1/s, C[Dim i + j] = d v_i / d x_j around the point; empty unless transfers are affine
  std::array<Column, static_cast<std::size_t>(Dim) * Dim> C;
  Column m;              ///< kg (per metre of depth in plane strain)
  Column V0;             ///< m3 (m2 in plane strain), volume before loading
  Column J;              ///< -, volume / V0
  Column gap;            ///< -, volumetric strain by which the point stands open
  Column plastic_strain; ///< -, equivalent, deviatoric
  Column dissipation;    ///< J/m3 of V0, plastic work so far
  std::vector<std::uint32_t> id;
  std::vector<std::uint8_t> material; ///< index into Scene::materials
  std::vector<std::uint8_t> region;   ///< index into Scene::regions

  std::size_t size() const { return id.size(); }

  Vec<Dim> position(std::size_t p) const { return at(x, p); }
  Vec<Dim> velocity(std::size_t p) const { return at(v, p); }

  bool affine() const { return !C[0].empty(); }

  /// Bytes of all columns.
  std::size_t memory() const {
    std::size_t bytes = 0;
    // It lends columns to those who change them as well.
    const_cast<Particles&>(*this).for_each_column(
        [&](const auto& column) { bytes += bytes_of(column); });
    return bytes;
  }

  /// Calls visit(column) for every column in use, whatever its type.
  template <class Visit> void for_each_column(Visit&& visit) {
    for (auto& column : x) visit(column);
    for (auto& column : v) visit(column);
    for (auto& column : dx) visit(column);
    for (auto& column : tau) visit(column);
    if (affine())
      for (auto& column : C) visit(column);
    visit(m);
    visit(V0);
    visit(J);
    visit(gap);
    visit(plastic_strain);
    visit(dissipation);
    visit(id);
    visit(material);
    visit(region);
  }

 private:
  static Vec<Dim> at(const std::array<Column, Dim>& columns, std::size_t p) {
    Vec<Dim> value;
    for (std::size_t i = 0; i < Dim; ++i) value[i] = columns[i][p];
    return value;
  }
};

} // namespace scarp
