#include "core/loads.hpp"

#include "core/error.hpp"
#include "core/grid_index.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace scarp {

template <int Dim> Loads<Dim>::Loads(const Scene& scene) {
  for (int a = 0; a < Dim; ++a)
    gravity_[static_cast<std::size_t>(a)] = scene.gravity[scene_axis<Dim>(a)];
  for (const Region& region : scene.regions) regions_.push_back(region.name);
}

template <int Dim> void Loads<Dim>::begin_stage(const Stage& stage, double start_time) {
  for (const auto& entry : stage.body_force)
    if (std::ranges::find(regions_, entry.first) == regions_.end())
      throw SetupError("stage '" + stage.name + "': no region '" + entry.first + "'");
  start_ = start_time;
  all_ = stage.gravity;
  vary_ = !all_.constant();
  by_region_.clear();
  for (const std::string& region : regions_) {
    const auto entry = stage.body_force.find(region);
    by_region_.push_back(entry == stage.body_force.end() ? Ramp{} : entry->second);
    vary_ = vary_ || !by_region_.back().constant();
  }
  update(start_time);
}

template <int Dim> void Loads<Dim>::update(double time) {
  const double t = time - start_;
  const double all = all_.at(t);
  std::vector<double> factors;
  for (const Ramp& ramp : by_region_) factors.push_back(all * ramp.at(t));
  const auto scaled = [&](double factor) {
    Vec<Dim> b = gravity_;
    for (Real& component : b) component *= factor;
    return b;
  };
  own_.clear();
  common_ = {};
  if (std::ranges::all_of(factors, [&](double factor) { return factor == factors.front(); }))
    common_ = scaled(factors.empty() ? all : factors.front());
  else
    for (const double factor : factors) own_.push_back(scaled(factor));
}

template <int Dim> Real Loads<Dim>::largest() const {
  Real most2 = 0.0;
  for (std::size_t r = 0; r < regions_.size(); ++r) {
    Real b2 = 0.0;
    for (const Real component : force(r)) b2 += component * component;
    most2 = std::max(most2, b2);
  }
  return std::sqrt(most2);
}

template <int Dim> Vec<Dim> Loads<Dim>::force(std::size_t region) const {
  return own_.empty() ? common_ : own_[region];
}

template <int Dim>
template <class T>
std::vector<Vec<Dim>> Loads<Dim>::moments(const Particles<Dim, T>& points) const {
  // Part by part, so that the sum does not depend on threads.
  constexpr std::size_t rows_of_part = 4096;
  const std::size_t rows = points.rows(), regions = regions_.size();
  const std::size_t parts = (rows + rows_of_part - 1) / rows_of_part;
  std::vector<Vec<Dim>> of_parts(parts * regions);
  const auto n = static_cast<std::int64_t>(parts);
#pragma omp parallel for schedule(static)
  for (std::int64_t k = 0; k < n; ++k) {
    const std::size_t part = static_cast<std::size_t>(k), first = part * rows_of_part;
    for (std::size_t p = first; p < std::min(first + rows_of_part, rows); ++p)
      for (std::size_t i = 0; i < Dim; ++i)
        of_parts[part * regions + points.region[p]][i] += points.mass(p) * points.x[i][p];
  }
  std::vector<Vec<Dim>> sums(regions);
  for (std::size_t k = 0; k < of_parts.size(); ++k)
    for (std::size_t i = 0; i < Dim; ++i) sums[k % regions][i] += of_parts[k][i];
  return sums;
}

template <int Dim>
template <class T>
Real Loads<Dim>::potential(const Particles<Dim, T>& points) const {
  const std::vector<Vec<Dim>> now = moments(points);
  Real sum = 0.0;
  for (std::size_t r = 0; r < now.size(); ++r)
    for (std::size_t i = 0; i < Dim; ++i) sum -= force(r)[i] * now[r][i];
  return sum;
}

template <int Dim> template <class T> Real Loads<Dim>::work(const Particles<Dim, T>& points) const {
  return work_at(moments(points));
}

template <int Dim> Real Loads<Dim>::work_at(const std::vector<Vec<Dim>>& now) const {
  Real sum = work_;
  for (std::size_t r = 0; r < settled_.size(); ++r)
    for (std::size_t i = 0; i < Dim; ++i) sum += force(r)[i] * (now[r][i] - settled_[r][i]);
  return sum;
}

template <int Dim> template <class T> void Loads<Dim>::settle(const Particles<Dim, T>& points) {
  std::vector<Vec<Dim>> now = moments(points);
  work_ = work_at(now);
  settled_ = std::move(now);
}

template class Loads<2>;
template class Loads<3>;
template Real Loads<2>::potential(const Particles<2, Real>&) const;
template Real Loads<2>::work(const Particles<2, Real>&) const;
template void Loads<2>::settle(const Particles<2, Real>&);
template Real Loads<2>::potential(const Particles<2, float>&) const;
template Real Loads<2>::work(const Particles<2, float>&) const;
template void Loads<2>::settle(const Particles<2, float>&);
template Real Loads<3>::potential(const Particles<3, Real>&) const;
template Real Loads<3>::work(const Particles<3, Real>&) const;
template void Loads<3>::settle(const Particles<3, Real>&);
template Real Loads<3>::potential(const Particles<3, float>&) const;
template Real Loads<3>::work(const Particles<3, float>&) const;
template void Loads<3>::settle(const Particles<3, float>&);

} // namespace scarp
