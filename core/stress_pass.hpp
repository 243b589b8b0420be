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
// Volume.  The law adds up strains, so what it presses, opens and dilates together is log J: in a
// step J grows by exp(y), y = dt tr d less what the law has forgotten.  With 1 + y instead every
// step takes y^2/2 from log J, to and fro alike, and a point that springs gets smaller without end.
// (2 + y)/(2 - y) is exp(y) but for y^3/12, odd in y, so that a swing there and back leaves
// nothing; exp(y) itself is taken for the few points where y is not small.  (The law itself stays
// with dt d: with it the force is adjoint, and no swing makes energy.)
#pragma once

#include "core/evolving_strength.hpp"
#include "core/state.hpp"

#include <limits>

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

/// grad v = sum_I v_I (x) grad N_I at the points of a rank; 0 in empty rows.
template <int Dim, class Shape>
[[gnu::always_inline]] inline Mat<Dim, Pack<typename Shape::Number>>
velocity_gradients(const State<Dim, Shape>& state, const TileLanes<Dim, Shape>& tile,
                   const auto& along, const auto& rank) {
  const auto empty = !tile.filled(rank);
  Mat<Dim, Pack<typename Shape::Number>> grad_v;
  unrolled<Dim>([&](auto j) __attribute__((always_inline)) {
    auto functions = along.w;
    functions[j] = along.dw[j];
    unrolled<Dim>([&](auto i) __attribute__((always_inline)) {
      grad_v[i][j] = interpolate(functions, tile.at_nodes(state.nodal.nodes.v[i]));
      where(empty, grad_v[i][j]) = 0.0F;
    });
  });
  return grad_v;
}

/// By lane, the mean of the points' rates of volume in the cell: sum V0 tr(grad v) / sum V0.
template <int Dim, class Shape>
[[gnu::always_inline]] inline Pack<typename Shape::Number>
mean_rate_of_cells(const State<Dim, Shape>& state, const TileLanes<Dim, Shape>& tile) {
  using T = typename Shape::Number;
  Pack<T> sum = T(0), weight = T(0);
  for (const auto rank : tile.ranks()) {
    const auto along = Shape::along(tile.local_position(rank), tile.stencil());
    const auto grad_v = velocity_gradients(state, tile, along, rank);
    const Pack<T> V0 = load_lanes(&state.particles.V0[rank.row]);
    for (std::size_t i = 0; i < Dim; ++i) sum += V0 * grad_v[i][i];
    weight += V0;
  }
  where(weight == 0.0F, weight) = 1.0F;
  return sum / weight;
}

/// Keeps the gaps of a rank within their room, ln(1/fraction).  Few need the logarithm: it is not
/// less than 2 (1 - fraction)/(1 + fraction).
template <int Dim, class T>
[[gnu::always_inline]] inline void bound_gap(PlasticStep<T>& plastic, T& gap,
                                             const std::type_identity_t<T>& fraction,
                                             const SymTensor<Dim, T>& tau) {
  if (none_of(gap > 0.0F && gap * (1.0F + fraction) > 2.0F * (1.0F - fraction))) return;
  const T room = max(-log(fraction), T(0.0F));
  const T beyond = max(gap - room, T(0.0F));
  gap -= beyond;
  plastic.forgotten += beyond;
  plastic.dissipation += trace<Dim, T>(tau) * number<T>(1.0 / 3.0) * beyond;
}

/// exp(y); see above.
template <class T> [[gnu::always_inline]] inline Pack<T> growth(const Pack<T>& y) {
  Pack<T> factor = (2.0F + y) / (2.0F - y);
  if (const auto large = y * y > 0.25F; any_of(large)) where(large, factor) = exp(y);
  return factor;
}

/// The points of one material, which remembers gaps if it `opens`, in one tile.  Moduli and law are
/// copies: what is only referred to would be read again after every store.
template <int Dim, bool opens, class Law, class Shape>
[[gnu::hot]] void stress_tile(State<Dim, Shape>& state, std::size_t number_of_tile,
                              std::uint8_t material, ElasticModuli moduli, Law law, Real dt) {
  using T = typename Shape::Number;
  Particles<Dim, T>& points = state.particles;
  const TileLanes<Dim, Shape> tile(state, number_of_tile);
  Pack<T> mean_rate = T(0);
  if (state.averages_volume) mean_rate = mean_rate_of_cells(state, tile);
  for (const auto rank : tile.ranks()) {
    const std::size_t row = rank.row;
    const auto own = tile.filled(rank) && tile.of_material(rank, material);
    if (none_of(own)) continue;
    const auto store = [&](const Pack<T>& values, ColumnOf<T>& column)
        __attribute__((always_inline)) {
      Pack<T> all = load_lanes(&column[row]);
      where(own, all) = values;
      store_lanes(all, &column[row]);
    };
    const auto along = Shape::along(tile.local_position(rank), tile.stencil());
    const Mat<Dim, Pack<T>> grad_v = velocity_gradients(state, tile, along, rank);
    Pack<T> rate = T(0), dilation = T(0);
    unrolled<Dim>([&](auto i) __attribute__((always_inline)) { rate += grad_v[i][i]; });
    if (state.averages_volume) {
      dilation = mean_rate - rate;
      rate = mean_rate;
    }
    SymTensor<Dim, Pack<T>> tau;
    unrolled<tensor_size<Dim>>([&](auto i) __attribute__((always_inline)) {
      tau[i] = load_lanes(&points.tau[i][row]);
    });
    Pack<T> gap = T(0);
    if constexpr (opens) gap = load_lanes(&points.gap[row]);
    const Pack<T> room = opens ? std::numeric_limits<T>::infinity() : T(0); // bounded below
    const Pack<T> strain = load_lanes(&points.plastic_strain[row]);
    PlasticStep<Pack<T>> plastic = update_stress<Dim, Pack<T>>(
        tau, gap, room, grad_v, dilation, dt, moduli, law_in_step<Pack<T>>(law, strain, dt));
    if constexpr (opens)
      if (plastic.happened)
        bound_gap<Dim>(plastic, gap,
                       interpolate(along.w, tile.at_nodes(state.nodal.nodes.fraction)), tau);
    unrolled<tensor_size<Dim>>([&](auto i) __attribute__((always_inline)) {
      store(tau[i], points.tau[i]);
    });
    Pack<T> grown = number<T>(dt) * rate; // log J
    if (plastic.happened) {
      if constexpr (opens) store(gap, points.gap);
      store(strain + plastic.strain, points.plastic_strain);
      store(load_lanes(&points.dissipation[row]) + plastic.dissipation, points.dissipation);
      // A gap that is not remembered is no volume of the material either: else it adds up for ever.
      grown -= plastic.forgotten;
    }
    store(load_lanes(&points.J[row]) * growth<T>(grown), points.J);
  }
}

/// The same, with Opening at run time.
template <int Dim, class Law, class Shape>
void stress_of_tile(State<Dim, Shape>& state, std::size_t tile, std::uint8_t material,
                    const ElasticModuli& moduli, const Law& law, bool opens, Real dt) {
  with_flag(opens, [&](auto with_gaps) {
    stress_tile<Dim, with_gaps.value>(state, tile, material, moduli, law, dt);
  });
}

/// All points of one material (which remembers gaps, if it `opens`), with the nodes' present
/// velocities.
template <int Dim, class Law, class Shape>
void stress_pass(State<Dim, Shape>& state, std::uint8_t material, const ElasticModuli& moduli,
                 const Law& law, bool opens, Real dt) {
  for_each_tile(state, [&](std::size_t tile) {
    stress_of_tile<Dim>(state, tile, material, moduli, law, opens, dt);
  });
}

} // namespace scarp
