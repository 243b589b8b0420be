// Strain increment and stress of every point.
//
// The law is written for the Kirchhoff stress tau = J sigma, with the Jaumann rate:
//   d tau/dt = W tau - tau W + lambda tr(d) I + 2 G d,   then the plastic return.
// The internal force is - V0 tau . grad N, and its power - V0 tau : d is the very rate at which
// the stored energy V0 psi(tau) changes: strain and force are adjoint with the fixed weight V0, so
// no volume change can create energy.  Writing the law for sigma with the current volume V instead
// makes a point's stiffness grow with V: a point that has opened in tension by a factor J has the
// wave speed sqrt(J) c, which breaks the step's CFL condition and throws the point.
#pragma once

#include "core/drucker_prager.hpp"
#include "core/state.hpp"

namespace scarp {

/// tau <- R tau R^T with the rotation of Hughes & Winget 1980 (doi 10.1002/nme.1620151210),
/// R = (I - W/2)^-1 (I + W/2): exactly orthogonal, so rotation alone never changes an invariant.
/// `w` holds the spin increment: Dim 2: W_xz; Dim 3: W_xy, W_yz, W_xz.
template <int Dim> void rotate(SymTensor<Dim>& tau, const std::array<Real, Dim == 2 ? 1 : 3>& w) {
  if constexpr (Dim == 2) {
    const Real a = 0.5 * w[0]; // R = [[c, s], [-s, c]]
    const Real scale = 1.0 / (1.0 + a * a);
    const Real c = (1.0 - a * a) * scale;
    const Real s = 2.0 * a * scale;
    const Real mean = 0.5 * (tau[0] + tau[1]);
    const Real half = 0.5 * (tau[0] - tau[1]);
    const Real cos2 = c * c - s * s;
    const Real sin2 = 2.0 * c * s;
    const Real half_new = cos2 * half + sin2 * tau[3];
    tau[3] = cos2 * tau[3] - sin2 * half;
    tau[0] = mean + half_new;
    tau[1] = mean - half_new;
  } else {
    const Real a = 0.5 * w[0];
    const Real b = 0.5 * w[1];
    const Real c = 0.5 * w[2]; // A = W/2 = [[0, a, c], [-a, 0, b], [-c, -b, 0]]
    const Real scale = 2.0 / (1.0 + a * a + b * b + c * c);
    // A^2 = n n^T - |n|^2 I with the axis n = (b, -c, a); Cayley: R = I + scale (A + A^2)
    const Mat<3> R = {
        {{1.0 - scale * (a * a + c * c), scale * (a - b * c), scale * (c + a * b)},
         {scale * (-a - b * c), 1.0 - scale * (a * a + b * b), scale * (b - a * c)},
         {scale * (-c + a * b), scale * (-b - a * c), 1.0 - scale * (b * b + c * c)}}};
    const Mat<3> T = {
        {{tau[0], tau[3], tau[5]}, {tau[3], tau[1], tau[4]}, {tau[5], tau[4], tau[2]}}};
    Mat<3> RT = {};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t k = 0; k < 3; ++k) RT[i][j] += R[i][k] * T[k][j];
    const auto entry = [&](std::size_t i, std::size_t j) {
      return RT[i][0] * R[j][0] + RT[i][1] * R[j][1] + RT[i][2] * R[j][2];
    };
    tau = {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(0, 2)};
  }
}

/// Stress after the strain increment dt sym(grad_v) and spin dt skw(grad_v): elastic trial, then
/// the law's return.  Returns what was irreversible.
template <int Dim, class Law>
PlasticStep update_stress(SymTensor<Dim>& tau, const Mat<Dim>& grad_v, Real dt,
                          const ElasticModuli& moduli, const Law& law) {
  const auto spin = [&](std::size_t i, std::size_t j) {
    return 0.5 * dt * (grad_v[i][j] - grad_v[j][i]);
  };
  if constexpr (Dim == 2)
    rotate<2>(tau, {spin(0, 1)});
  else
    rotate<3>(tau, {spin(0, 1), spin(1, 2), spin(0, 2)});

  Real volumetric = 0.0;
  for (std::size_t i = 0; i < Dim; ++i) volumetric += dt * grad_v[i][i];
  const Real lame = (moduli.bulk - 2.0 / 3.0 * moduli.shear) * volumetric;
  for (std::size_t i = 0; i < 3; ++i) tau[i] += lame;
  for (std::size_t i = 0; i < Dim; ++i) {
    tau[i] += 2.0 * moduli.shear * dt * grad_v[i][i];
    for (std::size_t j = i + 1; j < Dim; ++j)
      tau[component<Dim>(static_cast<int>(i), static_cast<int>(j))] +=
          moduli.shear * dt * (grad_v[i][j] + grad_v[j][i]);
  }
  return law.template operator()<Dim>(tau);
}

/// All points of one material, with grad v = sum_I v_I (x) grad N_I of the nodes' present
/// velocities.
template <int Dim, class Law>
void stress_pass(State<Dim>& state, std::uint8_t material, const ElasticModuli& moduli,
                 const Law& law, Real dt) {
  constexpr std::size_t corners = GridIndex<Dim>::corners;
  Particles<Dim>& points = state.particles;
  for_each_cell(state, [&](std::size_t slot) {
    const int cell = state.order.cell(slot);
    const int first = state.grid.first_node(cell);
    std::array<Vec<Dim>, corners> v_I;
    for (std::size_t c = 0; c < corners; ++c)
      v_I[c] = state.nodal.nodes[static_cast<std::size_t>(first + state.grid.corner_offset[c])].v;
    const Vec<Dim> corner = corner_of(state.grid, cell);

    for (std::size_t k = state.order.begin(slot); k < state.order.end(slot); ++k) {
      const std::size_t p = state.order.row(k);
      if (points.material[p] != material) continue;
      const LinearShape<Dim> shape = shape_at(state, corner, p);
      Mat<Dim> grad_v = {};
      for (std::size_t c = 0; c < corners; ++c)
        for (std::size_t i = 0; i < Dim; ++i)
          for (std::size_t j = 0; j < Dim; ++j) grad_v[i][j] += v_I[c][i] * shape.dN[c][j];

      SymTensor<Dim> tau;
      for (std::size_t i = 0; i < tau.size(); ++i) tau[i] = points.tau[i][p];
      const PlasticStep plastic = update_stress<Dim>(tau, grad_v, dt, moduli, law);
      for (std::size_t i = 0; i < tau.size(); ++i) points.tau[i][p] = tau[i];
      points.plastic_strain[p] += plastic.strain;
      points.dissipation[p] += plastic.dissipation;
      Real volumetric = 0.0;
      for (std::size_t i = 0; i < Dim; ++i) volumetric += grad_v[i][i];
      points.J[p] *= 1.0 + dt * volumetric;
    }
  });
}

} // namespace scarp
