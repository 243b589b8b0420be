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
#pragma once

#include "core/drucker_prager.hpp"
#include "core/state.hpp"

#include <experimental/simd>

namespace scarp {

/// tau <- R tau R^T with the rotation of Hughes & Winget 1980 (doi 10.1002/nme.1620151210),
/// R = (I - W/2)^-1 (I + W/2): exactly orthogonal, so rotation alone never changes an invariant.
/// `w` holds the spin increment: Dim 2: W_xz; Dim 3: W_xy, W_yz, W_xz.
template <int Dim, class T>
void rotate(SymTensor<Dim, T>& tau, const std::array<T, Dim == 2 ? 1 : 3>& w) {
  if constexpr (Dim == 2) {
    const T a = 0.5 * w[0]; // R = [[c, s], [-s, c]]
    const T scale = 1.0 / (1.0 + a * a);
    const T c = (1.0 - a * a) * scale;
    const T s = 2.0 * a * scale;
    const T mean = 0.5 * (tau[0] + tau[1]);
    const T half = 0.5 * (tau[0] - tau[1]);
    const T cos2 = c * c - s * s;
    const T sin2 = 2.0 * c * s;
    const T half_new = cos2 * half + sin2 * tau[3];
    tau[3] = cos2 * tau[3] - sin2 * half;
    tau[0] = mean + half_new;
    tau[1] = mean - half_new;
  } else {
    const T a = 0.5 * w[0];
    const T b = 0.5 * w[1];
    const T c = 0.5 * w[2]; // A = W/2 = [[0, a, c], [-a, 0, b], [-c, -b, 0]]
    const T scale = 2.0 / (1.0 + a * a + b * b + c * c);
    // A^2 = n n^T - |n|^2 I with the axis n = (b, -c, a); Cayley: R = I + scale (A + A^2)
    const Mat<3, T> R = {
        {{1.0 - scale * (a * a + c * c), scale * (a - b * c), scale * (c + a * b)},
         {scale * (-a - b * c), 1.0 - scale * (a * a + b * b), scale * (b - a * c)},
         {scale * (a * b - c), scale * (-b - a * c), 1.0 - scale * (b * b + c * c)}}};
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
template <int Dim, class T = Real, class Law>
PlasticStep<T> update_stress(SymTensor<Dim, T>& tau, T& gap, const std::type_identity_t<T>& room,
                             const Mat<Dim, T>& grad_v, const std::type_identity_t<T>& dilation,
                             Real dt, const ElasticModuli& moduli, const Law& law) {
  const auto spin = [&](std::size_t i, std::size_t j) -> T {
    return 0.5 * dt * (grad_v[i][j] - grad_v[j][i]);
  };
  if constexpr (Dim == 2)
    rotate<2, T>(tau, {spin(0, 1)});
  else
    rotate<3, T>(tau, {spin(0, 1), spin(1, 2), spin(0, 2)});

  T volumetric = 0.0;
  for (std::size_t i = 0; i < Dim; ++i) volumetric += dt * grad_v[i][i];
  const T lame =
      (moduli.bulk - 2.0 / 3.0 * moduli.shear) * volumetric + moduli.bulk * dt * dilation;
  for (std::size_t i = 0; i < 3; ++i) tau[i] += lame;
  for (std::size_t i = 0; i < Dim; ++i) {
    tau[i] += 2.0 * moduli.shear * dt * grad_v[i][i];
    for (std::size_t j = i + 1; j < Dim; ++j)
      tau[component<Dim>(static_cast<int>(i), static_cast<int>(j))] +=
          moduli.shear * dt * (grad_v[i][j] + grad_v[j][i]);
  }
  return law.template operator()<Dim, T>(tau, gap, room);
}

/// The same with Opening::forgotten.
template <int Dim, class T = Real, class Law>
PlasticStep<T> update_stress(SymTensor<Dim, T>& tau, const Mat<Dim, T>& grad_v, Real dt,
                             const ElasticModuli& moduli, const Law& law) {
  T gap = 0.0;
  return update_stress<Dim, T>(tau, gap, T(0.0), grad_v, T(0.0), dt, moduli, law);
}

/// Several points in the lanes of one register.
using RealPack = std::experimental::native_simd<Real>;

/// Points treated together: gathered from their rows, updated a pack at a time, written back.
template <int Dim> struct StressBatch {
  static constexpr std::size_t capacity = 64;
  using Lanes = std::array<Real, capacity>;
  std::size_t size = 0;
  bool opens = false; ///< whether the law remembers gaps; `gap` and `room` are 0 otherwise
  std::array<std::uint32_t, capacity> row = {};
  Mat<Dim, Lanes> grad_v = {};
  Lanes dilation = {}; ///< 1/s, rate of volume beyond tr(grad_v); 0 without cell averages
  SymTensor<Dim, Lanes> tau = {};
  Lanes strain = {};
  Lanes dissipation = {};
  Lanes forgotten = {};
  Lanes gap = {};
  Lanes room = {};
};

template <int Dim, class Law>
void update_batch(StressBatch<Dim>& batch, Particles<Dim>& points, Real dt,
                  const ElasticModuli& moduli, const Law& law) {
  constexpr auto plain = std::experimental::element_aligned;
  for (std::size_t i = 0; i < batch.tau.size(); ++i)
    for (std::size_t k = 0; k < batch.size; ++k) batch.tau[i][k] = points.tau[i][batch.row[k]];

  for (std::size_t k = 0; k < batch.size; k += RealPack::size()) {
    Mat<Dim, RealPack> grad_v;
    for (std::size_t i = 0; i < Dim; ++i)
      for (std::size_t j = 0; j < Dim; ++j) grad_v[i][j].copy_from(&batch.grad_v[i][j][k], plain);
    SymTensor<Dim, RealPack> tau;
    for (std::size_t i = 0; i < tau.size(); ++i) tau[i].copy_from(&batch.tau[i][k], plain);
    RealPack gap(&batch.gap[k], plain);
    const RealPack room(&batch.room[k], plain);
    const RealPack dilation(&batch.dilation[k], plain);
    const PlasticStep<RealPack> plastic =
        update_stress<Dim, RealPack>(tau, gap, room, grad_v, dilation, dt, moduli, law);
    gap.copy_to(&batch.gap[k], plain);
    for (std::size_t i = 0; i < tau.size(); ++i) tau[i].copy_to(&batch.tau[i][k], plain);
    plastic.strain.copy_to(&batch.strain[k], plain);
    plastic.dissipation.copy_to(&batch.dissipation[k], plain);
    plastic.forgotten.copy_to(&batch.forgotten[k], plain);
  }

  for (std::size_t i = 0; i < batch.tau.size(); ++i)
    for (std::size_t k = 0; k < batch.size; ++k) points.tau[i][batch.row[k]] = batch.tau[i][k];
  for (std::size_t k = 0; k < batch.size; ++k) {
    const std::size_t p = batch.row[k];
    points.plastic_strain[p] += batch.strain[k];
    if (batch.opens) points.gap[p] = batch.gap[k];
    points.dissipation[p] += batch.dissipation[k];
    Real volumetric = batch.dilation[k];
    for (std::size_t i = 0; i < Dim; ++i) volumetric += batch.grad_v[i][i][k];
    // A gap that is not remembered is no volume of the material either: else it adds up for ever.
    points.J[p] *= (1.0 + dt * volumetric) / (1.0 + batch.forgotten[k]);
  }
  batch.size = 0;
}

/// All points of one material (which remembers gaps, if it `opens`), with grad v = sum_I v_I (x)
/// grad N_I of the nodes' present velocities.
template <int Dim, class Law, class Shape>
void stress_pass(State<Dim, Shape>& state, std::uint8_t material, const ElasticModuli& moduli,
                 const Law& law, bool opens, Real dt) {
  constexpr std::size_t corners = State<Dim, Shape>::corners;
  Particles<Dim>& points = state.particles;
  const auto cells = static_cast<std::int64_t>(state.order.cells());
#pragma omp parallel
  {
    StressBatch<Dim> batch;
    batch.opens = opens;
#pragma omp for schedule(static) nowait
    for (std::int64_t s = 0; s < cells; ++s) {
      const auto slot = static_cast<std::size_t>(s);
      const int first = state.grid.first_node(state.order.cell(slot));
      std::array<Vec<Dim>, corners> v_I;
      std::array<Real, corners> fraction_I;
      for (std::size_t c = 0; c < corners; ++c) {
        const auto node = static_cast<std::size_t>(first + state.grid.corner_offset[c]);
        v_I[c] = state.nodal.nodes[node].v;
        fraction_I[c] = state.nodal.nodes[node].fraction;
      }
      const StencilCell<Dim> cell = stencil_cell(state, slot);
      const auto gradient = [&](const Shape& shape) {
        Mat<Dim> grad_v = {};
        for (std::size_t c = 0; c < corners; ++c)
          for (std::size_t i = 0; i < Dim; ++i)
            for (std::size_t j = 0; j < Dim; ++j) grad_v[i][j] += v_I[c][i] * shape.dN[c][j];
        return grad_v;
      };
      const auto divergence = [&](std::size_t p) {
        const Mat<Dim> grad_v = gradient(shape_at(state, cell, p));
        Real sum = 0.0;
        for (std::size_t i = 0; i < Dim; ++i) sum += grad_v[i][i];
        return sum;
      };
      const Real mean_rate = state.averages_volume ? cell_mean(state, slot, divergence) : 0.0;

      for (std::size_t k = state.order.begin(slot); k < state.order.end(slot); ++k) {
        const std::uint32_t p = state.order.row(k);
        if (points.material[p] != material) continue;
        const Shape shape = shape_at(state, cell, p);
        const Mat<Dim> grad_v = gradient(shape);
        if (state.averages_volume) {
          Real own = 0.0;
          for (std::size_t i = 0; i < Dim; ++i) own += grad_v[i][i];
          batch.dilation[batch.size] = mean_rate - own;
        }
        for (std::size_t i = 0; i < Dim; ++i)
          for (std::size_t j = 0; j < Dim; ++j) batch.grad_v[i][j][batch.size] = grad_v[i][j];
        if (opens) {
          Real fraction = 0.0;
          for (std::size_t c = 0; c < corners; ++c) fraction += shape.N[c] * fraction_I[c];
          batch.room[batch.size] = std::max(1.0 / fraction - 1.0, 0.0);
          batch.gap[batch.size] = points.gap[p];
        }
        batch.row[batch.size++] = p;
        if (batch.size == batch.capacity) update_batch(batch, points, dt, moduli, law);
      }
    }
    update_batch(batch, points, dt, moduli, law);
  }
}

} // namespace scarp
