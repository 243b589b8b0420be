// The longest step that an explicit integration allows.
//
// Waves.  With lumped masses the grid's stiffness and mass are both sums over the points,
//   K = sum_p V0_p B_p^T D B_p,   M = sum_p m_p diag(N_Ip),
// so its highest frequency is at most that of any single point (Irons & Treharne 1971; Fried 1972):
//   w^2 <= max_p  largest eigenvalue of  D/rho sum_I grad N_I (x) grad N_I / N_I.
// For a product of functions w_k along the axes that sum has the diagonal sum_k w_k'^2 / w_k <=
// kappa / h^2 (Shape::gradient_bound), and an isotropic D has the eigenvalue Dim lambda + 2 G for a
// change of volume:
//   w^2 <= kappa (Dim lambda + 2 G) / (rho h^2),   dt <= 2 / w,
// wherever the points lie and whatever their masses: B-splines and GIMP.  For linear functions w^2
// grows without bound as a point nears a cell's end; the step is then the one of a mesh of full
// cells, h / c with the speed c of P-waves.
//
// Stress.  A point's force V0 tau . grad N also changes as the point moves, by a stiffness of the
// size of tau.  It counts for nothing where the material is soil, but where a body's weight, sum_i
// rho |b_i| L_i with its extents L_i, is more than the modulus in confined compression, M, so is
// its stress, and the step is that of a material as stiff as it is heavy.
//
// Motion.  A point does not overtake the wall that it falls on: dt v |grad N| h <= h, with the
// steepest function at a wall (Shape::steepest / h), dt <= h / (steepest v), and dt <= sqrt(h /
// (steepest b)) where a body force b sets it going.
#pragma once

#include "core/drucker_prager.hpp"
#include "core/grid_index.hpp"

#include <algorithm>
#include <cmath>

namespace scarp {

/// h / (critical step of waves), m/s.
template <int Dim, class Shape>
Real critical_speed(const ElasticModuli& moduli, Real density, Real half_point) {
  if constexpr (Shape::layout == NodeLayout::corner) {
    return std::sqrt(moduli.p_wave() / density);
  } else {
    const Real lame = moduli.bulk - 2.0 / 3.0 * moduli.shear;
    const Real volumetric = std::max(Dim * lame, 0.0) + 2.0 * moduli.shear;
    return 0.5 * std::sqrt(Shape::gradient_bound(half_point) * volumetric / density);
  }
}

/// sqrt(max(1, weight / M)) of a region in a stage: how many times faster its waves count.
Real crushing(const Scene& scene, const Region& region, const Stage& stage);

/// Of a stage: the largest of what its regions are made of, times the largest crushing().
Real critical_speed(const Scene& scene, const Stage& stage);

/// s; `wave`: critical_speed, m/s; `fastest`: of the points, m/s; `body_force`: m/s2; `steepest`:
/// of the shape functions.
inline Real critical_step(Real h, Real wave, Real fastest, Real body_force, Real steepest) {
  const Real of_speeds = h / (wave + steepest * fastest);
  return body_force > 0.0 ? std::min(of_speeds, std::sqrt(h / (steepest * body_force))) : of_speeds;
}

/// Part of FLIP in a step that is the part `cfl` of the critical one, where `flip` is that at 0.3.
/// What points have and the grid does not see is multiplied by it at every step: with this power
/// it dies off as fast in time whatever the step, and so results do not change with it.
inline Real flip_of_step(Real flip, Real cfl) { return std::pow(flip, cfl / 0.3); }

} // namespace scarp
