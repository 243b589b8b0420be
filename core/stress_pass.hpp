// Strain increment and stress of every point.
//
// The law is written for the Kirchhoff stress tau = J sigma, with the Jaumann rate:
//   d tau/dt = W tau - tau W + lambda tr(d) I + 2 G d,   then the plastic return.
// The internal force is - V0 tau . grad N, and its power - V0 tau : d is the very rate at which
// the stored energy V0 psi(tau) changes: strain and force are adjoint with the fixed weight V0, so
// no volume change can create energy.  Writing the law for sigma with the current volume V instead
// makes a point's stiffness grow with V: a point that has opened in tension by a factor J has the
// wave speed sqrt(J) c, which breaks the step's CFL condition and throws the point.
//
// Cell averages.  Points in a cell whose material keeps its volume over-constrain its nodes:
// volumetric locking.  With the rate of volume averaged over the cell's points,
//   d -> d + (mean(tr d) - tr d) / 3 I,   mean(a) = sum_p V0_p a_p / sum_p V0_p,
// there is one constraint a cell (B-bar, Hughes 1980, doi 10.1002/nme.1620150914, with the points
// for a rule).  The power sum_p V0_p tau_p : d_p is then that of the force in which the mean stress
// of every point is the cell's mean(p): again adjoint, again no energy from nothing.
//
// Motion.  With MUSL the strain sees the remapped velocity v*; as published, points move with the
// one before it, v.  The two differ by what the points do not keep: a node that hardly carries mass
// has a velocity dt f/m afresh each step, and in v it moves the points beside it.  Then strain and
// place drift apart, and a film that lies at rest on a wall creeps, by dt g (x/h)^2 / 2, against
// gravity.  With affine transfers points therefore move with v* (`moves_with_strain`): what gravity
// does to points is then what it does to nodes, and for a steady v* = R (v* + dt f/m), with the
// transfers there and back as a symmetric R between 0 and 1, the power f . v* of what is not in
// balance is never negative, so nothing at rest gains energy.
#pragma once

#include "core/drucker_prager.hpp"
#include "core/state.hpp"

namespace scarp {

/// tau <- R tau R^T with the rotation of Hughes & Winget 1980 (doi 10.1002/nme.1620151210),
/// R = (I - W/2)^-1 (I + W/2): exactly orthogonal, so rotation alone never changes an invariant.
/// `w` holds the spin increment: Dim 2: W_xz; Dim 3: W_xy, W_yz, W_xz.
template <int Dim, class T>
[[gnu::always_inline]] inline void rotate(SymTensor<Dim, T>& tau,
                                          const std::array<T, Dim == 2 ? 1 : 3>& w) {
  if constexpr (Dim == 2) {
    const T a = 0.5F * w[0]; // R = [[c, s], [-s, c]]
    const T scale = 1.0F / (1.0F + a * a);
    const T c = (1.0F - a * a) * scale;
    const T s = 2.0F * a * scale;
    const T mean = 0.5F * (tau[0] + tau[1]);
    const T half = 0.5F * (tau[0] - tau[1]);
    const T cos2 = c * c - s * s;
    const T sin2 = 2.0F * c * s;
    const T half_new = cos2 * half + sin2 * tau[3];
    tau[3] = cos2 * tau[3] - sin2 * half;
    tau[0] = mean + half_new;
    tau[1] = mean - half_new;
  } else {
    const T a = 0.5F * w[0];
    const T b = 0.5F * w[1];
    const T c = 0.5F * w[2]; // A = W/2 = [[0, a, c], [-a, 0, b], [-c, -b, 0]]
    const T scale = 2.0F / (1.0F + a * a + b * b + c * c);
    // A^2 = n n^T - |n|^2 I with the axis n = (b, -c, a); Cayley: R = I + scale (A + A^2)
    const Mat<3, T> R = {
        {{1.0F - scale * (a * a + c * c), scale * (a - b * c), scale * (c + a * b)},
         {scale * (-a - b * c), 1.0F - scale * (a * a + b * b), scale * (b - a * c)},
         {scale * (a * b - c), scale * (-b - a * c), 1.0F - scale * (b * b + c * c)}}};
    const Mat<3, T> S = {
        {{tau[0], tau[3], tau[5]}, {tau[3], tau[1], tau[4]}, {tau[5], tau[4], tau[2]}}};
    Mat<3, T> RS;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        RS[i][j] = R[i][0] * S[0][j] + R[i][1] * S[1][j] + R[i][2] * S[2][j];
    const auto entry = [&](std::size_t i, std::size_t j) -> T {
      return RS[i][0] * R[j][0] + RS[i][1] * R[j][1] + RS[i][2] * R[j][2];
    };
    tau = {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(0, 2)};
  }
}

/// Stress after the strain increment dt (sym(grad_v) + dilation / 3 I) and spin dt skw(grad_v):
/// elastic trial, then the law's return.  Returns what was irreversible.  `gap` and `room`: see
/// core/drucker_prager.hpp.
/// The trial is tau <- R (tau + dtau/2) R^T + dtau/2, the trapezoidal rule in the frame that turns
/// with the spin, of second order; the isotropic part of dtau is the same on either side of R.
template <int Dim, class T = Real, class Law>
[[gnu::always_inline]] inline PlasticStep<T>
update_stress(SymTensor<Dim, T>& tau, T& gap, const std::type_identity_t<T>& room,
              const Mat<Dim, T>& grad_v, const std::type_identity_t<T>& dilation, Real dt,
              const ElasticModuli& moduli, const Law& law) {
  const auto step = number<T>(dt), half_step = number<T>(0.5 * dt);
  const auto shear = number<T>(moduli.shear * dt), half_shear = number<T>(0.5 * moduli.shear * dt);
  const auto add_half_of_shear = [&]() __attribute__((always_inline)) { // of 2 G dt d
    for (std::size_t i = 0; i < Dim; ++i) {
      tau[i] += shear * grad_v[i][i];
      for (std::size_t j = i + 1; j < Dim; ++j)
        tau[component<Dim>(static_cast<int>(i), static_cast<int>(j))] +=
            half_shear * (grad_v[i][j] + grad_v[j][i]);
    }
  };
  const auto spin = [&](std::size_t i, std::size_t j) -> T {
    return half_step * (grad_v[i][j] - grad_v[j][i]);
  };
  add_half_of_shear();
  if constexpr (Dim == 2)
    rotate<2, T>(tau, {spin(0, 1)});
  else
    rotate<3, T>(tau, {spin(0, 1), spin(1, 2), spin(0, 2)});
  add_half_of_shear();

  T volumetric = 0.0F;
  for (std::size_t i = 0; i < Dim; ++i) volumetric += step * grad_v[i][i];
  const T lame = number<T>(moduli.bulk - 2.0 / 3.0 * moduli.shear) * volumetric +
                 number<T>(moduli.bulk * dt) * dilation;
  for (std::size_t i = 0; i < 3; ++i) tau[i] += lame;
  return law.template operator()<Dim, T>(tau, gap, room);
}

/// The same with Opening::forgotten.
template <int Dim, class T = Real, class Law>
PlasticStep<T> update_stress(SymTensor<Dim, T>& tau, const Mat<Dim, T>& grad_v, Real dt,
                             const ElasticModuli& moduli, const Law& law) {
  T gap = 0.0F;
  return update_stress<Dim, T>(tau, gap, T(0.0F), grad_v, T(0.0F), dt, moduli, law);
}

/// What the points of a block of cells feel, line after line.
template <int Dim, class T> struct StrainRates {
  BlockLines<Dim * Dim, T> grad_v; ///< 1/s, [Dim i + j] = d v_i / d x_j
  BlockLines<1, T> dilation;       ///< 1/s, rate of volume beyond tr(grad_v)
  BlockLines<1, T> fraction;       ///< -, if the law remembers gaps
  BlockLines<Dim, T> velocity;     ///< m/s, if points move with the strain

  void resize(std::size_t rows) {
    grad_v.resize(rows);
    dilation.resize(rows);
    fraction.resize(rows);
    velocity.resize(rows);
  }
};

/// grad v = sum_I v_I (x) grad N_I at the points of a block.
template <int Dim, class Shape, class T>
void find_strain_rates(const State<Dim, Shape>& state, const CellBlock& block, bool opens,
                       BlockLines<Dim, T>& xi, StrainRates<Dim, T>& rates) {
  const Nodes<Dim, T>& nodes = state.nodal.nodes;
  const Corners<Dim, Shape> corners(state);
  xi.resize(block.size);
  rates.resize(block.size);
  for (std::size_t k = 0; k < block.size; k += RowPack<T>::capacity) {
    const std::array<Pack<T>, Dim> place = local_position(state, block.pack<T>(k));
    for (std::size_t i = 0; i < Dim; ++i) store_lanes(place[i], xi[i] + k);
  }

  // Lanes beyond a cell's last point are written again with the next cell.
  std::size_t begin = 0;
  for (std::size_t slot = block.first_slot; slot < block.end_slot; ++slot) {
    const std::size_t end = begin + state.order.end(slot) - state.order.begin(slot);
    const StencilCell<Dim> cell = stencil_cell(state, slot);
    const int node = state.order.place(slot).first_node;
    for (std::size_t k = begin; k < end; k += Pack<T>::size()) {
      std::array<Pack<T>, Dim> place;
      for (std::size_t i = 0; i < Dim; ++i) place[i] = load_lanes(xi[i] + k);
      const auto along = Shape::along(place, cell);
      for (std::size_t j = 0; j < Dim; ++j) {
        auto functions = along.w;
        functions[j] = along.dw[j];
        for (std::size_t i = 0; i < Dim; ++i)
          store_lanes(interpolate(functions, corners.of(nodes.v[i], node)),
                      rates.grad_v[Dim * i + j] + k);
      }
      if (opens)
        store_lanes(interpolate(along.w, corners.of(nodes.fraction, node)), rates.fraction[0] + k);
      if (state.moves_with_strain)
        for (std::size_t i = 0; i < Dim; ++i)
          store_lanes(interpolate(along.w, corners.of(nodes.v[i], node)), rates.velocity[i] + k);
    }

    if (state.averages_volume) {
      const auto own_rate = [&](std::size_t k) {
        T sum = 0;
        for (std::size_t i = 0; i < Dim; ++i) sum += rates.grad_v[Dim * i + i][k];
        return sum;
      };
      T sum = 0, weight = 0;
      for (std::size_t k = begin; k < end; ++k) {
        const T V0 = state.particles.V0[block.rows[k]];
        sum += V0 * own_rate(k);
        weight += V0;
      }
      for (std::size_t k = begin; k < end; ++k) rates.dilation[0][k] = sum / weight - own_rate(k);
    }
    begin = end;
  }
}

/// Stresses of the points in a pack, whose rates begin at k.  Those of other materials, if there
/// are any, stay.
template <int Dim, bool opens, class T, class Law>
[[gnu::always_inline]] inline void
update_pack(Particles<Dim, T>& points, const RowPack<T>& rows, StrainRates<Dim, T>& rates,
            std::size_t k, const typename Pack<T>::mask_type* of_others, bool averages, Real dt,
            const ElasticModuli& moduli, const Law& law) {
  const auto store = [&](Pack<T> values, ColumnOf<T>& column) {
    if (of_others) where(*of_others, values) = rows.load(column);
    rows.store(values, column);
  };
  const Pack<T> dilation = averages ? load_lanes(rates.dilation[0] + k) : Pack<T>(0.0F);
  Pack<T> rate = dilation;
  Mat<Dim, Pack<T>> grad_v;
  unrolled<Dim>([&](auto i) {
    unrolled<Dim>([&](auto j) { grad_v[i][j] = load_lanes(rates.grad_v[Dim * i + j] + k); });
    rate += grad_v[i][i];
  });
  SymTensor<Dim, Pack<T>> tau;
  unrolled<tensor_size<Dim>>([&](auto i) { tau[i] = rows.load(points.tau[i]); });
  Pack<T> gap = 0.0F, room = 0.0F;
  if constexpr (opens) {
    gap = rows.load(points.gap);
    room = max(1.0F / load_lanes(rates.fraction[0] + k) - 1.0F, Pack<T>(0.0F));
  }
  const PlasticStep<Pack<T>> plastic =
      update_stress<Dim, Pack<T>>(tau, gap, room, grad_v, dilation, dt, moduli, law);
  unrolled<tensor_size<Dim>>([&](auto i) { store(tau[i], points.tau[i]); });
  Pack<T> J = rows.load(points.J) * (1.0F + number<T>(dt) * rate);
  if (plastic.happened) {
    if constexpr (opens) store(gap, points.gap);
    store(rows.load(points.plastic_strain) + plastic.strain, points.plastic_strain);
    store(rows.load(points.dissipation) + plastic.dissipation, points.dissipation);
    // A gap that is not remembered is no volume of the material either: else it adds up for ever.
    J /= 1.0F + plastic.forgotten;
  }
  store(J, points.J);
}

/// All points of one material (which remembers gaps, if it `opens`), with the nodes' present
/// velocities.
template <int Dim, class Law, class Shape>
void stress_pass(State<Dim, Shape>& state, std::uint8_t material, const ElasticModuli& moduli,
                 const Law& law, bool opens, Real dt) {
  using T = typename Shape::Number;
  Particles<Dim, T>& points = state.particles;
  const std::int64_t blocks = block_count(state);
#pragma omp parallel
  {
    BlockLines<Dim, T> xi;
    StrainRates<Dim, T> rates;
#pragma omp for schedule(static)
    for (std::int64_t b = 0; b < blocks; ++b) {
      const CellBlock block = cell_block(state, b);
      std::size_t own = 0;
      for (std::size_t k = 0; k < block.size; ++k)
        own += points.material[block.rows[k]] == material ? 1U : 0U;
      if (own == 0) continue;
      find_strain_rates(state, block, opens, xi, rates);
      for (std::size_t k = 0; state.moves_with_strain && k < block.size;
           k += RowPack<T>::capacity) {
        const RowPack<T> rows = block.pack<T>(k);
        for (std::size_t i = 0; i < Dim; ++i)
          rows.store(number<T>(dt) * load_lanes(rates.velocity[i] + k), points.dx[i]);
      }
      const auto update = [&]<bool with_gaps>(std::bool_constant<with_gaps>) {
        for (std::size_t k = 0; k < block.size; k += RowPack<T>::capacity) {
          const RowPack<T> rows = block.pack<T>(k);
          typename Pack<T>::mask_type others(false);
          if (own < block.size)
            for (std::size_t lane = 0; lane < rows.size(); ++lane)
              others[lane] = points.material[block.rows[k + lane]] != material;
          update_pack<Dim, with_gaps>(points, rows, rates, k, own < block.size ? &others : nullptr,
                                      state.averages_volume, dt, moduli, law);
        }
      };
      if (opens)
        update(std::true_type());
      else
        update(std::false_type());
    }
  }
}

} // namespace scarp
