// The material points: all state, as structure of arrays.
#pragma once

#include "core/memory.hpp"
#include "core/types.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <tuple>
#include <type_traits>
#include <vector>

namespace scarp {

using Column = ColumnOf<Real>;

/// The id of a row without a point.
inline constexpr std::uint32_t no_point = std::numeric_limits<std::uint32_t>::max();

/// Row p of every column belongs to one material point, or is empty: `id` is no_point, J 1 and all
/// else 0, so that sums over rows need not ask.  CellOrder says which row is whose; `id` is the
/// point's place in the order of creation and never changes.  Positions are doubles whatever T is,
/// so that accuracy does not depend on where the origin lies; the passes take from them where a
/// point lies in its cell.
template <int Dim, class T = Real> struct Particles {
  using Column = ColumnOf<T>;

  std::array<ColumnOf<Real>, Dim> x;        ///< m, position
  std::array<Column, Dim> v;                ///< m/s
  std::array<Column, tensor_size<Dim>> tau; ///< Pa, Kirchhoff stress (see core/stress_pass.hpp)
  /// 1/s, C[Dim i + j] = d v_i / d x_j around the point; empty unless transfers are affine
  std::array<Column, static_cast<std::size_t>(Dim) * Dim> C;
  Column m;   ///< kg (per metre of depth in plane strain); empty if all have one `density`
  Column V0;  ///< m3 (m2 in plane strain), volume before loading
  Column J;   ///< -, volume / V0
  Column gap; ///< -, volumetric strain by which the point stands open; empty if it is forgotten
  Column plastic_strain; ///< -, equivalent, deviatoric
  Column dissipation;    ///< J/m3 of V0, plastic work so far
  ColumnOf<std::uint32_t> id;
  ColumnOf<std::uint8_t> material; ///< index into Scene::materials
  ColumnOf<std::uint8_t> region;   ///< index into Scene::regions
  T density = 0;                   ///< kg/m3, before loading, of every point; if `m` is empty

  Particles() = default;
  /// The same points with numbers of another type.
  template <class U>
  requires(!std::is_same_v<T, U>) explicit Particles(const Particles<Dim, U>& other)
      : x(other.x), id(other.id), material(other.material), region(other.region),
        density(static_cast<T>(other.density)) {
    const auto take = [](Column& column, const ColumnOf<U>& from) {
      column.assign(from.begin(), from.end());
    };
    for (std::size_t i = 0; i < Dim; ++i) take(v[i], other.v[i]);
    for (std::size_t i = 0; i < tau.size(); ++i) take(tau[i], other.tau[i]);
    for (std::size_t i = 0; i < C.size(); ++i) take(C[i], other.C[i]);
    take(m, other.m);
    take(V0, other.V0);
    take(J, other.J);
    take(gap, other.gap);
    take(plastic_strain, other.plastic_strain);
    take(dissipation, other.dissipation);
  }

  std::size_t rows() const { return id.size(); }

  /// Calls visit(p) for every row with a point.
  template <class Visit> void for_each(Visit&& visit) const {
    for (std::size_t p = 0; p < rows(); ++p)
      if (id[p] != no_point) visit(p);
  }

  /// Adds empty rows.
  void resize(std::size_t rows) {
    for_each_column([&](auto& column) { grow(column, rows, of_empty_row(column)); });
  }

  /// Row p becomes row to[p], if that is a row; all others are empty.
  void rearrange(const std::vector<std::uint32_t>& to, std::size_t new_rows) {
    const auto n = static_cast<std::int64_t>(rows());
    // The columns pass their memory on: what is new has to be given by the system, page by page.
    std::tuple<ColumnOf<Real>, ColumnOf<float>, ColumnOf<std::uint32_t>, ColumnOf<std::uint8_t>>
        spare;
    for_each_column([&](auto& column) {
      auto& fresh = std::get<std::remove_cvref_t<decltype(column)>>(spare);
      fresh.assign(new_rows, of_empty_row(column));
#pragma omp parallel for schedule(static)
      for (std::int64_t k = 0; k < n; ++k) {
        const auto p = static_cast<std::size_t>(k);
        if (to[p] < new_rows) fresh[to[p]] = column[p];
      }
      column.swap(fresh);
    });
  }

  /// Bytes of a row on its way to another one.
  std::size_t row_bytes() const {
    std::size_t bytes = 0;
    for_each_column([&](const auto& column) { bytes += sizeof(column[0]); });
    return bytes;
  }

  /// Takes the point out of a row, which is empty then.
  void take_out(std::size_t row, std::byte* to) {
    for_each_column([&](auto& column) {
      std::memcpy(to, &column[row], sizeof(column[row]));
      to += sizeof(column[row]);
      column[row] = of_empty_row(column);
    });
  }

  void put_in(std::size_t row, const std::byte* from) {
    for_each_column([&](auto& column) {
      std::memcpy(&column[row], from, sizeof(column[row]));
      from += sizeof(column[row]);
    });
  }

  /// A point goes to another row; its own is empty then.
  void move_row(std::size_t from, std::size_t to) {
    for_each_column([&](auto& column) {
      column[to] = column[from];
      column[from] = of_empty_row(column);
    });
  }

  /// kg, of row p.
  T mass(std::size_t p) const { return m.empty() ? density * V0[p] : m[p]; }
  Vec<Dim> position(std::size_t p) const { return at(x, p); }
  Vec<Dim, T> velocity(std::size_t p) const { return at(v, p); }

  bool affine() const { return !C[0].empty(); }

  /// Bytes of all columns.
  std::size_t memory() const {
    std::size_t bytes = 0;
    for_each_column([&](const auto& column) { bytes += bytes_of(column); });
    return bytes;
  }

  /// Calls visit(column) for every column in use, whatever its type.
  template <class Visit> void for_each_column(Visit&& visit) { for_each_column_of(*this, visit); }
  template <class Visit> void for_each_column(Visit&& visit) const {
    for_each_column_of(*this, visit);
  }

 private:
  template <class Self, class Visit> static void for_each_column_of(Self& self, Visit&& visit) {
    for (auto& column : self.x) visit(column);
    for (auto& column : self.v) visit(column);
    for (auto& column : self.tau) visit(column);
    if (self.affine())
      for (auto& column : self.C) visit(column);
    if (!self.m.empty()) visit(self.m);
    visit(self.V0);
    visit(self.J);
    if (!self.gap.empty()) visit(self.gap);
    visit(self.plastic_strain);
    visit(self.dissipation);
    visit(self.id);
    visit(self.material);
    visit(self.region);
  }

  template <class Number> Number of_empty_row(const ColumnOf<Number>& column) const {
    if constexpr (std::is_same_v<Number, std::uint32_t>) return no_point;
    return static_cast<Number>(static_cast<const void*>(&column) == &J ? 1 : 0);
  }

  template <class Number>
  static Vec<Dim, Number> at(const std::array<ColumnOf<Number>, Dim>& columns, std::size_t p) {
    Vec<Dim, Number> value;
    for (std::size_t i = 0; i < Dim; ++i) value[i] = columns[i][p];
    return value;
  }
};

} // namespace scarp
