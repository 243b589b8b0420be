// What a run tells of its state: energies, fields, the plan.  The rest of core/simulation_of.hpp.
#pragma once

#include "core/simulation_of.hpp"

namespace scarp {

template <int Dim, class Shape> Energies SimulationOf<Dim, Shape>::energies() const {
  const auto& points = state_.particles;
  Energies now;
  points.for_each([&](std::size_t p) {
    Real v2 = 0.0;
    for (std::size_t i = 0; i < Dim; ++i) v2 += points.v[i][p] * points.v[i][p];
    if (points.affine()) v2 += affine_square(state_, p);
    now.kinetic += 0.5 * points.mass(p) * v2;
    now.plastic += points.V0[p] * points.dissipation[p];

    // psi = sigma_m^2 / 2K + sigma_m gap + s:s / 4G; where there is a gap, sigma_m = sigma_t
    const ElasticModuli& moduli = materials_[points.material[p]].moduli;
    Real mean = 0.0;
    for (std::size_t i = 0; i < 3; ++i) mean += points.tau[i][p] / 3.0;
    Real s2 = 0.0;
    for (std::size_t i = 0; i < points.tau.size(); ++i) {
      const Real s = points.tau[i][p] - (i < 3 ? mean : 0.0);
      s2 += (i < 3 ? 1.0 : 2.0) * s * s;
    }
    now.strain +=
        points.V0[p] * (mean * (0.5 * mean / moduli.bulk + gap(p)) + 0.25 * s2 / moduli.shear);
  });
  const auto& nodes = state_.nodal.nodes;
  for (const auto& run : state_.order.node_runs())
    for (std::size_t k = static_cast<std::size_t>(run.node), end = k + run.count; k < end; ++k)
      for (const auto& v : nodes.v) now.grid_kinetic += 0.5 * nodes.m[k] * v[k] * v[k];
  now.damping = damping_work_;
  now.wall_friction = friction_work_;
  now.gravitational = loads_.potential(points);
  now.gravity_work = loads_.work(points);
  now.scheme_loss = now.gravity_work - (now.kinetic - first_energies_.kinetic) -
                    (now.strain - first_energies_.strain) - now.plastic - now.damping -
                    now.wall_friction;
  return now;
}

template <int Dim, class Shape> std::vector<double> SimulationOf<Dim, Shape>::positions() const {
  const auto& points = state_.particles;
  std::vector<double> values(3 * this->points(), 0.0);
  points.for_each([&](std::size_t p) {
    for (int a = 0; a < Dim; ++a)
      values[3 * points.id[p] + scene_axis<Dim>(a)] = points.x[static_cast<std::size_t>(a)][p];
  });
  return values;
}

template <int Dim, class Shape>
std::vector<double> SimulationOf<Dim, Shape>::field(const std::string& name) const {
  const auto& points = state_.particles;
  const auto components = static_cast<std::size_t>(field_info(name).components);
  std::vector<double> values(components * this->points(), 0.0);

  const auto scalar = [&](auto&& value) {
    points.for_each([&](std::size_t p) { values[points.id[p]] = value(p); });
  };
  const auto mean_stress = [&](std::size_t p) {
    return (points.tau[0][p] + points.tau[1][p] + points.tau[2][p]) / (3.0 * points.J[p]);
  };
  if (name == "displacement") {
    values = positions();
    for (std::size_t p = 0; p < this->points(); ++p) {
      const Vec<Dim> first = first_places_.of(p);
      for (int a = 0; a < Dim; ++a)
        values[3 * p + scene_axis<Dim>(a)] -= first[static_cast<std::size_t>(a)];
    }
  } else if (name == "velocity") {
    points.for_each([&](std::size_t p) {
      for (int a = 0; a < Dim; ++a)
        values[3 * points.id[p] + scene_axis<Dim>(a)] = points.v[static_cast<std::size_t>(a)][p];
    });
  } else if (name == "velocity_gradient") {
    points.for_each([&](std::size_t p) {
      for (std::size_t i = 0; points.affine() && i < Dim; ++i)
        for (std::size_t j = 0; j < Dim; ++j)
          values[9 * points.id[p] + gradient_place<Dim>(i, j)] = points.C[Dim * i + j][p];
    });
  } else if (name == "stress") {
    points.for_each([&](std::size_t p) {
      for (std::size_t i = 0; i < stress_place<Dim>.size(); ++i)
        values[6 * points.id[p] + stress_place<Dim>[i]] = points.tau[i][p] / points.J[p];
    });
  } else if (name == "mean_stress") {
    scalar(mean_stress);
  } else if (name == "deviatoric_stress") {
    scalar([&](std::size_t p) {
      Real J2 = 0.0;
      for (std::size_t i = 0; i < points.tau.size(); ++i) {
        const Real s = points.tau[i][p] / points.J[p] - (i < 3 ? mean_stress(p) : 0.0);
        J2 += (i < 3 ? 0.5 : 1.0) * s * s;
      }
      return std::sqrt(J2);
    });
  } else if (name == "equivalent_plastic_strain") {
    scalar([&](std::size_t p) { return points.plastic_strain[p]; });
  } else if (name == "density") {
    scalar([&](std::size_t p) { return points.mass(p) / (points.V0[p] * points.J[p]); });
  } else if (name == "volume") {
    scalar([&](std::size_t p) { return points.V0[p] * points.J[p]; });
  } else if (name == "initial_volume") {
    scalar([&](std::size_t p) { return points.V0[p]; });
  } else if (name == "gap") {
    scalar([&](std::size_t p) { return gap(p); });
  } else if (name == "region") {
    scalar([&](std::size_t p) { return static_cast<double>(points.region[p]); });
  }
  return values;
}

template <int Dim, class Shape> std::string SimulationOf<Dim, Shape>::stages_line() const {
  if (scene_.stages.empty()) return "one";
  std::ostringstream text;
  for (std::size_t k = stage_; k < stages_.size(); ++k) {
    const Stage& stage = stages_[k];
    text << (k == stage_ ? "" : ", ") << stage.name << " (" << stage.duration << " s"
         << (stage.until_rest ? " or until rest" : "") << ")";
    if (!stage.begin_from.empty()) text << " from " << stage.begin_from;
  }
  return text.str();
}

template <int Dim, class Shape> std::string SimulationOf<Dim, Shape>::initial_stress_line() const {
  if (scene_.method.initial_stress == InitialStress::none) return "none, skipped";
  if (!equilibrium_) return "that of the run it begins from";
  if (equilibrium_->iterations == 0) return "static equilibrium without a load: none";
  std::ostringstream text;
  text.precision(2);
  text << "static equilibrium, " << equilibrium_->unknowns << " unknowns, "
       << equilibrium_->iterations << (equilibrium_->iterations == 1 ? " iteration" : " iterations")
       << ", residual " << equilibrium_->residual << " of the loads";
  return text.str();
}

template <int Dim, class Shape> std::vector<PlanLine> SimulationOf<Dim, Shape>::plan() const {
  const Method& method = scene_.method;
  const auto scheme = [&] {
    switch (method.scheme) {
    case Scheme::usf:
      return "USF: stress before the momentum, no second mapping";
    case Scheme::usl:
      return "USL: stress after the momentum, no second mapping";
    case Scheme::musl:
      break;
    }
    return "MUSL: stress after a second mapping of the momenta";
  };
  bool plastic = false, evolves = false;
  for (const Material& material : scene_.materials)
    if (const auto* law = std::get_if<DruckerPrager>(&material.law)) {
      plastic = true;
      evolves = evolves || law->evolves();
    }
  const std::string shape = Shape::layout == NodeLayout::corner   ? "linear"
                            : Shape::layout == NodeLayout::padded ? "uniform GIMP"
                                                                  : "quadratic B-spline";
  return {
      {"kinematics",
       Dim == 2 ? "plane strain; y is neither computed nor stored" : "three-dimensional"},
      {"shape functions", shape},
      {"scheme", scheme()},
      {"transfer",
       method.transfer == VelocityTransfer::flip ? "velocities" : "velocities and their gradients"},
      {"rate of volume",
       state_.averages_volume ? "mean of the cell" : "of the point, not averaged"},
      {"numbers",
       std::is_same_v<Number, Real> ? "double precision" : "single precision, positions double"},
      {"plasticity", plastic ? "Drucker-Prager; the return is skipped where points stay elastic"
                             : "none, skipped"},
      {"strength", evolves ? "changes with plastic strain or rate" : "constant"},
      {"gaps", remembers_gaps(scene_) ? "remembered: opened material has to close before it bears"
                                      : "forgotten, not stored"},
      {"local damping", method.local_damping > 0.0 ? "on" : "none, skipped"},
      {"settling", scene_.gates.empty()                   ? "no gate, skipped"
                   : scene_.method.settling_damping > 0.0 ? "damped until the last gate opens"
                                                          : "not damped"},
      {"friction walls", !walls_.friction().empty() ? "on" : "none, skipped"},
      {"initial stress", initial_stress_line()},
      {"stages", stages_line()},
      {"gates", scene_.gates.empty() ? "none, skipped" : std::to_string(scene_.gates.size())},
  };
}

} // namespace scarp
