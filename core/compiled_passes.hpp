// The passes that core/simulation_*.cpp compile, for other sources that call them: these would
// compile them again, a minute for all.
#pragma once

#include "core/gather_pass.hpp"
#include "core/gimp_shape.hpp"
#include "core/linear_shape.hpp"
#include "core/material_model.hpp"
#include "core/move_pass.hpp"
#include "core/node_pass.hpp"
#include "core/scatter_pass.hpp"
#include "core/spline_shape.hpp"
#include "core/stress_pass.hpp"

// `what` is `template` in the source that compiles the passes, `extern template` in all others.
// NOLINTBEGIN(bugprone-macro-parentheses): names of types go without
#define SCARP_PASSES(what, Dim, Shape, Number)                                                     \
  what void scatter_pass<Dim, Terms::mass_momentum>(State<Dim, Shape<Dim, Number>>&,               \
                                                    const std::vector<Vec<Dim>>&);                 \
  what void scatter_pass<Dim, Terms::force>(State<Dim, Shape<Dim, Number>>&,                       \
                                            const std::vector<Vec<Dim>>&);                         \
  what void scatter_pass<Dim, Terms::all>(State<Dim, Shape<Dim, Number>>&,                         \
                                          const std::vector<Vec<Dim>>&);                           \
  what void gather_momentum_pass(State<Dim, Shape<Dim, Number>>&, const Walls<Dim>&);              \
  what void advance_momentum_pass(State<Dim, Shape<Dim, Number>>&, const Walls<Dim>&,              \
                                  const Vec<Dim>&, Real, Real);                                    \
  what Real gather_pass<Dim, false>(State<Dim, Shape<Dim, Number>>&, Real);                        \
  what Real gather_pass<Dim, true>(State<Dim, Shape<Dim, Number>>&, Real);                         \
  what LostPoints move_tile(State<Dim, Shape<Dim, Number>>&, std::size_t, Real);                   \
  what void remap_velocity_pass(State<Dim, Shape<Dim, Number>>&, const Walls<Dim>&, Real);         \
  what void stress_of_tile<Dim>(State<Dim, Shape<Dim, Number>>&, std::size_t, std::uint8_t,        \
                                const ElasticModuli&, const ElasticUpdate&, bool, Real);           \
  what void stress_of_tile<Dim>(State<Dim, Shape<Dim, Number>>&, std::size_t, std::uint8_t,        \
                                const ElasticModuli&, const DruckerPragerUpdate&, bool, Real);     \
  what void stress_of_tile<Dim>(State<Dim, Shape<Dim, Number>>&, std::size_t, std::uint8_t,        \
                                const ElasticModuli&, const EvolvingStrengthUpdate&, bool, Real)
// NOLINTEND(bugprone-macro-parentheses)

namespace scarp {

SCARP_PASSES(extern template, 2, LinearShape, Real);
SCARP_PASSES(extern template, 3, LinearShape, Real);
SCARP_PASSES(extern template, 2, LinearShape, float);
SCARP_PASSES(extern template, 3, LinearShape, float);
SCARP_PASSES(extern template, 2, GimpShape, Real);
SCARP_PASSES(extern template, 3, GimpShape, Real);
SCARP_PASSES(extern template, 2, SplineShape, Real);
SCARP_PASSES(extern template, 3, SplineShape, Real);
SCARP_PASSES(extern template, 2, SplineShape, float);
SCARP_PASSES(extern template, 3, SplineShape, float);

} // namespace scarp
