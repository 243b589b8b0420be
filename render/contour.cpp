#include "render/contour.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <stdexcept>

namespace scarp::render {

namespace {

/// A crossing lies on the grid edge that starts at a node and runs right (0) or up (1).
using EdgeId = std::size_t;

struct Links {
  std::map<EdgeId, EdgeId> next; ///< along the line, higher values to the left
  std::map<EdgeId, EdgeId> previous;
};

Point crossing(const NodeField& field, EdgeId edge, double level) {
  const std::size_t node = edge / 2;
  const bool upwards = edge % 2 == 1;
  const std::size_t i = node % field.nodes_x;
  const std::size_t k = node / field.nodes_x;
  const double from = field.values[node];
  const double to = field.values[upwards ? node + field.nodes_x : node + 1];
  const double part = (level - from) / (to - from);
  const double h = field.cell_size;
  return {field.x(i) + (upwards ? 0.0 : part * h), field.z(k) + (upwards ? part * h : 0.0)};
}

/// The segments of one cell.  Corners and edges count anticlockwise from the lower left and the
/// lower side; a line enters where the edge goes from high to low and leaves where it rises.
void link_cell(const NodeField& field, std::size_t node, double level, Links& links) {
  const std::array<std::size_t, 4> corners = {node, node + 1, node + field.nodes_x + 1,
                                              node + field.nodes_x};
  const std::array<EdgeId, 4> edges = {2 * node, 2 * (node + 1) + 1, 2 * (node + field.nodes_x),
                                       2 * node + 1};
  std::array<bool, 4> high = {};
  double mean = 0.0;
  for (std::size_t c = 0; c < 4; ++c) {
    high[c] = field.values[corners[c]] >= level;
    mean += 0.25 * field.values[corners[c]];
  }
  const bool joined = mean >= level; // high corners of a saddle belong together
  for (std::size_t in = 0; in < 4; ++in) {
    if (!high[in] || high[(in + 1) % 4]) continue;
    // The line turns round the low corners that follow, or in a joined saddle just round the next;
    // in a split saddle it turns back round the high corner.
    std::size_t out = (in + 1) % 4;
    while (high[(out + 1) % 4] == high[out]) out = (out + 1) % 4;
    if (!joined && high[(in + 2) % 4] && !high[(in + 3) % 4]) out = (in + 3) % 4;
    links.next[edges[in]] = edges[out];
    links.previous[edges[out]] = edges[in];
  }
}

Polyline take_line(const NodeField& field, double level, EdgeId first, Links& links) {
  Polyline line = {crossing(field, first, level)};
  for (auto step = links.next.find(first); step != links.next.end();) {
    const EdgeId edge = step->second;
    line.push_back(crossing(field, edge, level));
    links.next.erase(step);
    links.previous.erase(edge);
    step = links.next.find(edge);
  }
  return line;
}

struct Vertex {
  Point point;
  double body = 0.0;
  double value = 0.0;
};

using Face = std::vector<Vertex>;

Vertex between(const Vertex& a, const Vertex& b, double part) {
  return {{a.point.x + part * (b.point.x - a.point.x), a.point.y + part * (b.point.y - a.point.y)},
          a.body + part * (b.body - a.body),
          a.value + part * (b.value - a.value)};
}

/// Keeps where `distance`, linear over the face, is not negative.
template <class Distance> void cut(const Face& face, Face& kept, Distance distance) {
  kept.clear();
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Vertex& a = face[i];
    const Vertex& b = face[i + 1 < face.size() ? i + 1 : 0];
    const double at_a = distance(a);
    const double at_b = distance(b);
    if (at_a >= 0.0) kept.push_back(a);
    if ((at_a >= 0.0) != (at_b >= 0.0)) kept.push_back(between(a, b, at_a / (at_a - at_b)));
  }
}

class BandSplitter {
 public:
  BandSplitter(const std::vector<double>& edges,
               const std::function<void(const Polyline&, std::size_t)>& emit)
      : edges_(edges), emit_(emit) {}

  /// The face as a whole if it is within the body and one band; false if it must be split.
  bool emit_whole(const Face& face) {
    const auto outside = [](const Vertex& vertex) { return vertex.body < body_level; };
    if (std::all_of(face.begin(), face.end(), outside)) return true;
    if (std::any_of(face.begin(), face.end(), outside)) return false;
    const auto [first, last] = range(face);
    if (first != last) return false;
    emit(face, first);
    return true;
  }

  void split(const Face& face) {
    cut(face, body_, [](const Vertex& vertex) { return vertex.body - body_level; });
    if (body_.size() < 3) return;
    const auto [first, last] = range(body_);
    for (std::size_t band = first; band <= last; ++band) {
      const double low = edges_[band];
      const double high = edges_[band + 1];
      above_ = body_;
      if (band > first)
        cut(body_, above_, [low](const Vertex& vertex) { return vertex.value - low; });
      part_ = above_;
      if (band < last)
        cut(above_, part_, [high](const Vertex& vertex) { return high - vertex.value; });
      if (part_.size() >= 3) emit(part_, band);
    }
  }

 private:
  std::size_t band(double value) const {
    const auto inner_begin = edges_.begin() + 1;
    const auto inner_end = edges_.end() - 1;
    return static_cast<std::size_t>(std::upper_bound(inner_begin, inner_end, value) - inner_begin);
  }

  std::pair<std::size_t, std::size_t> range(const Face& face) const {
    const auto [low, high] =
        std::minmax_element(face.begin(), face.end(),
                            [](const Vertex& a, const Vertex& b) { return a.value < b.value; });
    return {band(low->value), band(high->value)};
  }

  void emit(const Face& face, std::size_t band) {
    polygon_.resize(face.size());
    std::transform(face.begin(), face.end(), polygon_.begin(),
                   [](const Vertex& vertex) { return vertex.point; });
    emit_(polygon_, band);
  }

  const std::vector<double>& edges_;
  const std::function<void(const Polyline&, std::size_t)>& emit_;
  Face body_;
  Face above_;
  Face part_;
  Polyline polygon_;
};

} // namespace

std::vector<Polyline> contour_lines(const NodeField& field, double level) {
  Links links;
  for (std::size_t k = 0; k + 1 < field.nodes_z; ++k)
    for (std::size_t i = 0; i + 1 < field.nodes_x; ++i)
      link_cell(field, i + field.nodes_x * k, level, links);

  std::vector<EdgeId> starts; // of open lines
  for (const auto& [edge, following] : links.next)
    if (!links.previous.contains(edge)) starts.push_back(edge);
  std::vector<Polyline> lines;
  lines.reserve(starts.size());
  for (const EdgeId edge : starts) lines.push_back(take_line(field, level, edge, links));
  while (!links.next.empty())
    lines.push_back(take_line(field, level, links.next.begin()->first, links));
  return lines;
}

void filled_bands(const NodeField& body, const NodeField& field, const std::vector<double>& edges,
                  const std::function<void(const Polyline& polygon, std::size_t band)>& emit) {
  if (body.values.size() != field.values.size())
    throw std::invalid_argument("filled bands: the two fields have different nodes");
  if (edges.size() < 2) throw std::invalid_argument("filled bands: there is no band");
  BandSplitter splitter(edges, emit);
  Face cell(4);
  Face triangle(3);
  for (std::size_t k = 0; k + 1 < body.nodes_z; ++k) {
    for (std::size_t i = 0; i + 1 < body.nodes_x; ++i) {
      Vertex centre;
      for (std::size_t c = 0; c < 4; ++c) { // anticlockwise from the lower left
        const std::size_t right = c == 1 || c == 2 ? 1 : 0;
        const std::size_t up = c / 2;
        cell[c] = {{body.x(i + right), body.z(k + up)},
                   body.at(i + right, k + up),
                   field.at(i + right, k + up)};
        centre.body += 0.25 * cell[c].body;
        centre.value += 0.25 * cell[c].value;
      }
      if (splitter.emit_whole(cell)) continue;
      centre.point = {0.5 * (cell[0].point.x + cell[2].point.x),
                      0.5 * (cell[0].point.y + cell[2].point.y)};
      for (std::size_t c = 0; c < 4; ++c) {
        triangle = {cell[c], cell[(c + 1) % 4], centre};
        splitter.split(triangle);
      }
    }
  }
}

} // namespace scarp::render
