// Time and the numerical scheme.
#include "io/scene_sections.hpp"

#include "io/scene_schema.hpp"

namespace scarp::io {

namespace {

Option<Timing> end_time() {
  Option<Timing> option = number<Timing>(
      "end_s", "s", &Timing::end_time, {.above = 0},
      "Time at which the run ends. Required without [[stage]], to be left out with.");
  option.write = [](const Timing& timing, int) -> Json {
    return timing.end_time > 0.0 ? Json(timing.end_time) : Json();
  };
  return option;
}

/// First of its section, since it sets all the others.
Option<Method> preset_option() {
  Option<Method> option = word<Method, Preset>(
      "preset", &Method::preset, {{"accurate", Preset::accurate}, {"fidelity", Preset::fidelity}},
      "What the other options of this section are where they are not given: accurate (B-splines "
      "and AFLIP, the default) or fidelity (as published for landslides: linear functions and "
      "FLIP).");
  const auto read = option.read;
  option.read = [read](const toml::node& node, int dimension, Method& method) {
    Complaint wrong = read(node, dimension, method);
    if (!wrong) method = method_of(method.preset);
    return wrong;
  };
  return option;
}

} // namespace

Section<Timing> time_section() {
  Section<Timing> section = {
      .name = "time",
      .help = "Length of the run and of its steps.",
      .options = {
          end_time(),
          required(number<Timing>("output_interval_s", "s", &Timing::output_interval, {.above = 0},
                                  "Time between frames, at most the whole run.")),
          number<Timing>("history_interval_s", "s", &Timing::history_interval, {.at_least = 0},
                         "Time between rows of history.csv; 0: a tenth of output_interval_s."),
          number<Timing>("cfl", "", &Timing::cfl, {.above = 0, .at_most = 1},
                         "Time step as a part of the critical one; 0.3 where it is not given and "
                         "method.transfer is flip."),
          number<Timing>("max_step_s", "s", &Timing::max_time_step,
                         {.above = 0, .infinity = "no limit"}, "Largest time step."),
          number<Timing>("rest_energy_fraction", "", &Timing::rest_energy_fraction,
                         {.at_least = 0, .below = 1},
                         "The run (with stages: one until rest) ends early once the kinetic energy "
                         "has stayed below this part of its peak for rest_duration_s; 0: never."),
          number<Timing>("rest_duration_s", "s", &Timing::rest_duration, {.at_least = 0},
                         "How long the scene must be at rest; see rest_energy_fraction."),
      }};
  for (Option<Timing>& option : section.options) option.example = default_scene().timing;
  return section;
}

Section<Method> method_section() {
  Section<Method> section = {
      .name = "method",
      .help = "The numerical scheme.",
      .options = {
          preset_option(),
          word<Method, Scheme>(
              "scheme", &Method::scheme,
              {{"usf", Scheme::usf}, {"usl", Scheme::usl}, {"musl", Scheme::musl}},
              "When stress is updated: before the momentum (usf), after it (usl), or after it with "
              "the points' new momenta mapped to the grid again (musl)."),
          word<Method, ShapeFunctions>("shape", &Method::shape,
                                       {{"linear", ShapeFunctions::linear},
                                        {"gimp", ShapeFunctions::gimp},
                                        {"bspline", ShapeFunctions::bspline}},
                                       "Shape functions of the grid: linear, uniform GIMP, or "
                                       "quadratic B-splines."),
          word<Method, VolumeRate>(
              "volume_rate", &Method::volume_rate,
              {{"point", VolumeRate::point}, {"cell_average", VolumeRate::cell_average}},
              "The rate of volume of a point: its own, or the mean of its "
              "cell, against volumetric locking."),
          word<Method, VelocityTransfer>(
              "transfer", &Method::transfer,
              {{"flip", VelocityTransfer::flip},
               {"apic", VelocityTransfer::apic},
               {"aflip", VelocityTransfer::aflip}},
              "What points and nodes exchange: velocities, a blend of FLIP and PIC (flip); "
              "velocities with their gradients (apic); a blend of FLIP, also of the gradients, "
              "and APIC (aflip)."),
          word<Method, Precision>(
              "precision", &Method::precision,
              {{"double", Precision::double_precision}, {"single", Precision::single}},
              "Numbers of points and nodes; positions are double in both. Single "
              "goes with linear and bspline."),
          word<Method, InitialStress>(
              "initial_stress", &Method::initial_stress,
              {{"none", InitialStress::none}, {"static", InitialStress::equilibrium}},
              "The stress at time 0: none, or that of the static equilibrium under the loads of "
              "time 0. Strains, displacements and gaps count from there."),
          number<Method>(
              "flip", "", &Method::flip, {.at_least = 0, .at_most = 1},
              "Part of FLIP in what points keep in a step with time.cfl = 0.3, the rest is "
              "PIC; flip^(cfl / 0.3) with another. Used by flip."),
          number<Method>("affine_flip", "", &Method::affine_flip, {.at_least = 0, .at_most = 1},
                         "The same of aflip, where the rest is APIC."),
          number<Method>("local_damping", "", &Method::local_damping, {.at_least = 0, .below = 1},
                         "Cundall's non-viscous damping of the nodal forces."),
          number<Method>("settling_damping", "", &Method::settling_damping,
                         {.at_least = 0, .below = 1},
                         "The same while a gate has still to open; the larger of the two counts."),
      }};
  for (Option<Method>& option : section.options) option.example = default_scene().method;
  return section;
}

} // namespace scarp::io
