#include "render/body.hpp"

#include "render/contour.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace scarp::render {

namespace {

CurveError error_of(const io::Table& experiment, const std::function<double(double)>& model) {
  const std::vector<double>& x = experiment.column("x_m");
  const std::vector<double>& z = experiment.column("z_m");
  CurveError error;
  for (std::size_t row = 0; row < x.size(); ++row) {
    const double difference = model(x[row]) - z[row];
    error.rms += difference * difference;
    error.max = std::max(error.max, std::abs(difference));
    ++error.n;
  }
  if (error.n > 0) error.rms = std::sqrt(error.rms / static_cast<double>(error.n));
  return error;
}

double largest_x(const NodeField& fraction, const std::vector<Polyline>& surface) {
  const std::size_t last = fraction.nodes_x - 1;
  for (std::size_t k = 0; k < fraction.nodes_z; ++k)
    if (fraction.at(last, k) >= body_level) return fraction.x(last);
  double largest = fraction.lower.x;
  for (const Polyline& line : surface)
    for (const Point point : line) largest = std::max(largest, point.x);
  return largest;
}

struct LatticePoint {
  double x;     ///< m, undeformed
  double z;     ///< m, undeformed
  double moved; ///< m
};

/// The height of the failure line in one column; `column` ascends in z.
double transition(const std::vector<LatticePoint>& column, double threshold) {
  const LatticePoint& lowest = column.front();
  const LatticePoint& highest = column.back();
  const double spacing =
      column.size() > 1 ? (highest.z - lowest.z) / static_cast<double>(column.size() - 1) : 0.0;
  if (lowest.moved > threshold) return lowest.z - 0.5 * spacing;
  for (std::size_t i = 1; i < column.size(); ++i) {
    if (column[i].moved <= threshold) continue;
    const LatticePoint& below = column[i - 1];
    const double part = (threshold - below.moved) / (column[i].moved - below.moved);
    return below.z + part * (column[i].z - below.z);
  }
  return highest.z + 0.5 * spacing;
}

/// Occupied cells of the grid, and the largest connected set of them.
class Occupancy {
 public:
  explicit Occupancy(const io::Frame& frame) : frame_(frame) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool flat = frame.dimension == 2 && axis == 1;
      const double extent = frame.upper[axis] - frame.lower[axis];
      cells_[axis] = flat ? 1 : std::max(1L, std::lround(extent / frame.cell_size));
    }
    set_.assign(static_cast<std::size_t>(cells_[0] * cells_[1] * cells_[2]), empty);
    for (std::size_t p = 0; p < frame.size(); ++p)
      if (const auto cell = cell_of(p)) set_[index(*cell)] = occupied;
    keep_largest();
  }

  bool near_body(std::size_t p) const {
    const auto cell = cell_of(p);
    if (!cell) return false;
    bool found = false;
    constexpr long reach = 2;
    for_neighbours(*cell, reach,
                   [&](const Cell& other) { found = found || set_[index(other)] == body; });
    return found;
  }

 private:
  using Cell = std::array<long, 3>;
  static constexpr int empty = -2;
  static constexpr int occupied = -1; // in no set yet; sets count from 0
  static constexpr int body = 0;      // after keep_largest()

  std::size_t index(const Cell& cell) const {
    return static_cast<std::size_t>(cell[0] + cells_[0] * (cell[1] + cells_[1] * cell[2]));
  }

  std::optional<Cell> cell_of(std::size_t p) const {
    Cell cell = {0, 0, 0};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (frame_.dimension == 2 && axis == 1) continue;
      const double x = frame_.position[3 * p + axis];
      if (!(x >= frame_.lower[axis] && x <= frame_.upper[axis])) return std::nullopt;
      const auto at = static_cast<long>((x - frame_.lower[axis]) / frame_.cell_size);
      cell[axis] = std::min(at, cells_[axis] - 1);
    }
    return cell;
  }

  template <class Visit> void for_neighbours(const Cell& cell, long reach, Visit visit) const {
    Cell low = {};
    Cell high = {};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::max(0L, cell[axis] - reach);
      high[axis] = std::min(cells_[axis] - 1, cell[axis] + reach);
    }
    for (long z = low[2]; z <= high[2]; ++z)
      for (long y = low[1]; y <= high[1]; ++y)
        for (long x = low[0]; x <= high[0]; ++x) visit(Cell{x, y, z});
  }

  void keep_largest() {
    int sets = 0;
    int largest = occupied;
    std::size_t largest_size = 0;
    std::vector<Cell> front;
    for (std::size_t p = 0; p < frame_.size(); ++p) {
      const auto start = cell_of(p);
      if (!start || set_[index(*start)] != occupied) continue;
      std::size_t size = 0;
      set_[index(*start)] = sets;
      front.assign(1, *start);
      while (!front.empty()) {
        const Cell cell = front.back();
        front.pop_back();
        ++size;
        for_neighbours(cell, 1, [&](const Cell& other) {
          if (set_[index(other)] != occupied) return;
          set_[index(other)] = sets;
          front.push_back(other);
        });
      }
      if (size > largest_size) {
        largest = sets;
        largest_size = size;
      }
      ++sets;
    }
    for (int& set : set_) set = set == largest && set != occupied ? body : empty;
  }

  const io::Frame& frame_;
  std::array<long, 3> cells_ = {1, 1, 1};
  std::vector<int> set_;
};

} // namespace

std::optional<double> BodyShape::height_at(double x) const {
  const Point upper = fraction.upper();
  if (!(x >= fraction.lower.x && x <= upper.x)) return std::nullopt;
  const double along = (x - fraction.lower.x) / fraction.cell_size;
  const std::size_t i = std::min(static_cast<std::size_t>(along), fraction.nodes_x - 2);
  const double right = along - static_cast<double>(i);
  const auto at = [&](std::size_t k) {
    return (1.0 - right) * fraction.at(i, k) + right * fraction.at(i + 1, k);
  };
  if (at(fraction.nodes_z - 1) >= body_level) return upper.y;
  for (std::size_t k = fraction.nodes_z - 1; k-- > 0;) {
    const double below = at(k);
    if (below < body_level) continue;
    const double above = at(k + 1);
    return fraction.z(k) + fraction.cell_size * (below - body_level) / (below - above);
  }
  return std::nullopt;
}

BodyShape measure_body(const io::Frame& frame) {
  BodyShape body;
  body.fraction = volume_fraction(frame);
  body.free_surface = contour_lines(body.fraction, body_level);
  body.run_out = largest_x(body.fraction, body.free_surface);
  return body;
}

CurveError surface_error(const BodyShape& body, const io::Table& experiment) {
  return error_of(experiment, [&](double x) { return body.height_at(x).value_or(0.0); });
}

double FailureLine::z_at(double x_m) const {
  if (x.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto after = std::upper_bound(x.begin(), x.end(), x_m);
  if (after == x.begin()) return z.front();
  if (after == x.end()) return z.back();
  const auto i = static_cast<std::size_t>(after - x.begin());
  return z[i - 1] + (z[i] - z[i - 1]) * (x_m - x[i - 1]) / (x[i] - x[i - 1]);
}

Polyline FailureLine::line() const {
  Polyline points;
  for (std::size_t i = 0; i < x.size(); ++i) points.push_back({x[i], z[i]});
  return points;
}

FailureLine failure_line(const io::Frame& frame, double threshold) {
  if (frame.dimension != 2) throw std::invalid_argument("failure line: a plane-strain frame only");
  const std::vector<double>& u = frame.column("displacement").values;
  std::vector<LatticePoint> points(frame.size());
  for (std::size_t p = 0; p < points.size(); ++p)
    points[p] = {frame.position[3 * p] - u[3 * p], frame.position[3 * p + 2] - u[3 * p + 2],
                 std::hypot(u[3 * p], u[3 * p + 1], u[3 * p + 2])};
  std::sort(points.begin(), points.end(),
            [](const LatticePoint& a, const LatticePoint& b) { return a.x < b.x; });

  FailureLine line;
  const double same_column = 0.1 * frame.cell_size;
  for (auto first = points.begin(); first != points.end();) {
    const auto last = std::find_if(first, points.end(), [&](const LatticePoint& point) {
      return point.x - first->x >= same_column;
    });
    std::vector<LatticePoint> column(first, last);
    std::sort(column.begin(), column.end(),
              [](const LatticePoint& a, const LatticePoint& b) { return a.z < b.z; });
    line.x.push_back(first->x);
    line.z.push_back(transition(column, threshold));
    first = last;
  }
  return line;
}

CurveError failure_error(const FailureLine& line, const io::Table& experiment) {
  return error_of(experiment, [&](double x) { return line.z_at(x); });
}

std::vector<std::size_t> thrown_off(const io::Frame& frame) {
  const Occupancy occupancy(frame);
  std::vector<std::size_t> thrown;
  for (std::size_t p = 0; p < frame.size(); ++p)
    if (!occupancy.near_body(p)) thrown.push_back(p);
  return thrown;
}

std::optional<double> max_abs_volume_ratio_error(const io::Frame& frame) {
  if (!frame.has("volume") || !frame.has("initial_volume")) return std::nullopt;
  const std::vector<double>& V = frame.column("volume").values;
  const std::vector<double>& V0 = frame.column("initial_volume").values;
  double largest = 0.0;
  for (std::size_t p = 0; p < V.size(); ++p)
    largest = std::max(largest, std::abs(V[p] / V0[p] - 1.0));
  return largest;
}

} // namespace scarp::render
