#include "apps/stress_scenes.hpp"

#include "core/drucker_prager.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace scarp::apps {

namespace {

/// The standard's distributions differ from library to library; its engine does not.
class Random {
 public:
  Random(std::uint64_t seed, std::size_t number) {
    std::seed_seq mixed = {seed & 0xffffffffU, seed >> 32U, number & 0xffffffffU, number >> 32U};
    engine_.seed(mixed);
  }
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11U) * 0x1p-53;
  }
  double log_between(double low, double high) {
    return std::exp(between(std::log(low), std::log(high)));
  }
  bool chance(double part) { return between(0.0, 1.0) < part; }
  int whole(int low, int high) { return low + static_cast<int>(between(0.0, high - low + 1.0)); }

 private:
  std::mt19937_64 engine_;
};

using Shape = std::vector<std::array<double, 2>>; // x and z in cells, from the grid's lower corner

Shape box(double x, double z, double width, double height) {
  return {{x, z}, {x + width, z}, {x + width, z + height}, {x, z + height}};
}

constexpr double standard_gravity = 9.81; // m/s2

/// Draws a scene piece by piece.  Lengths are in cells until finish().
class Draft {
 public:
  Draft(std::uint64_t seed, std::size_t number) : random_(seed, number) {
    start_grid();
    start_body();
    choose_gravity();
    choose_method();
  }

  void block() { add(box(x_, z_, width_, height_), material()); }

  /// Slanted sides cut the lattice's squares.
  void slope() {
    const double middle = random_.between(0.0, width_);
    const double left = random_.between(0.0, middle);
    const double right = random_.between(middle, width_);
    const double shoulder = random_.between(0.5, 1.0) * height_;
    add({{x_, z_}, {x_ + width_, z_}, {x_ + right, z_ + height_}, {x_ + left, z_ + shoulder}},
        material());
  }

  /// A wedge, thinner than a lattice square nearly everywhere.
  void sliver() {
    const double thin = random_.log_between(1e-3, 1.0);
    if (random_.chance(0.5))
      add({{x_, z_}, {x_ + width_, z_}, {x_ + width_, z_ + thin}}, material());
    else
      add({{x_, z_}, {x_ + thin, z_}, {x_ + 0.5 * thin, z_ + height_}}, material());
  }

  /// Two materials, up to a hundred times as dense as each other, with a slanted interface.
  void layers() {
    const double left = height_ * random_.between(0.3, 0.7);
    const double right = height_ * random_.between(0.3, 0.7);
    const std::string below = material();
    const std::string above = material(random_.log_between(0.01, 100.0));
    add({{x_, z_}, {x_ + width_, z_}, {x_ + width_, z_ + right}, {x_, z_ + left}}, below);
    add({{x_, z_ + left},
         {x_ + width_, z_ + right},
         {x_ + width_, z_ + height_},
         {x_, z_ + height_}},
        above);
  }

  /// Lying on it, or let fall.
  void block_on_soil() {
    z_ = 0.0;
    const double soil = 0.6 * height_;
    const double gap = random_.chance(0.5) ? 0.0 : random_.between(0.1, 3.0);
    const double wide = width_ * random_.between(0.2, 0.6);
    const double aside = random_.between(0.0, width_ - wide);
    add(box(x_, 0.0, width_, soil), material());
    const std::string name = material(random_.log_between(0.1, 100.0));
    add(box(x_ + aside, soil + gap, wide, height_ - soil), name, speed(0.1));
  }

  void single_points() {
    const std::string name = material();
    const int count = random_.whole(1, 4);
    const double side = 1.0 / scene_.grid.points_per_cell; // of a lattice square
    for (int i = 0; i < count; ++i) {
      const double part = side * random_.log_between(0.01, 1.0);
      const double x = std::ceil(x_) + 2.0 * i * side + random_.between(0.0, side - part);
      const double z = side * random_.whole(0, 8);
      add(box(x, z, part, part), name, speed(0.3));
    }
    depth_ = 1.0 / scene_.grid.points_per_cell;
  }

  /// One point high.
  void thin_layer() {
    const double side = 1.0 / scene_.grid.points_per_cell;
    const double z = side * random_.whole(0, 6);
    const double thickness = side * random_.log_between(0.1, 1.0);
    const std::string name = material();
    add(box(x_, z, 3.0 * width_, thickness), name, speed(0.1));
  }

  /// Cut squares whose points lie all but on the planes between cells.
  void cell_boundary() {
    const double a_little = random_.log_between(1e-6, 1e-2);
    x_ = std::ceil(x_);
    z_ = random_.whole(0, 3);
    const std::string name = material();
    add(box(x_ - a_little, z_, std::ceil(width_) + 2.0 * a_little, std::ceil(height_) + a_little),
        name, speed(0.1));
  }

  void gate() {
    x_ = 2.0;
    width_ = std::ceil(width_);
    z_ = 0.0;
    block();
    gate_ = x_ + width_;
    scene_.method.settling_damping = random_.chance(0.5) ? random_.between(0.0, 0.9) : 0.0;
  }

  void collision() {
    const std::string name = material();
    const double gap = random_.between(0.0, 2.0);
    const std::array<double, 3> v = speed(0.3);
    add(box(x_, z_, 0.5 * width_, height_), name, v);
    const bool alike = random_.chance(0.5);
    add(box(x_ + 0.5 * width_ + gap, z_, 0.5 * width_, height_),
        alike ? name : material(random_.log_between(0.1, 10.0)), {-v[0], -v[1], -v[2]});
  }

  void impact() {
    const std::string name = material();
    add(box(x_, z_, width_, height_), name, speed(0.5));
  }

  /// Gravity that rises, then a region that is pulled harder than the other.
  void loads() {
    layers();
    Stage rising;
    rising.name = "rising";
    rising.duration = 0.4;
    rising.gravity.points = {{0.0, 0.0}, {0.3, 1.0}};
    Stage pulled;
    pulled.name = "pulled";
    pulled.duration = 0.6;
    pulled.body_force = {
        {scene_.regions[0].name, {{{0.0, 1.0}, {0.3, random_.between(0.0, 3.0)}}}}};
    scene_.stages = {rising, pulled};
  }

  /// Elastic or strong, between smooth walls; nothing should happen for long.
  void rest() {
    x_ = 0.0;
    width_ = std::ceil(width_);
    z_ = 0.0;
    confined_ = true;
    add(box(x_, z_, width_, height_), material());
    if (random_.chance(0.5)) scene_.materials.back().law = LinearElastic{};
  }

  /// Collapses under its own weight.
  void soft() {
    stiffness_ = random_.log_between(0.03, 3.0);
    slope();
  }

  Scene finish() {
    close_grid();
    scale();
    choose_time();
    return scene_;
  }

 private:
  void start_grid() {
    Grid& grid = scene_.grid;
    grid.dimension = random_.chance(0.15) ? 3 : 2;
    grid.cell_size = random_.log_between(0.01, 1.0);
    grid.points_per_cell = random_.whole(1, grid.dimension == 3 ? 2 : 4);
    for (double& corner : grid.lower) corner = random_.between(-10.0, 10.0);
  }

  void start_body() {
    const Grid& grid = scene_.grid;
    if (grid.dimension == 3) depth_ = random_.between(0.6, 3.0);
    const double points = random_.log_between(60.0, 400.0);
    const double area = points / std::pow(grid.points_per_cell, grid.dimension) / depth_;
    width_ = std::clamp(std::sqrt(area * random_.log_between(0.2, 5.0)), 0.8, 40.0);
    height_ = std::clamp(area / width_, 0.8, 40.0);
    x_ = random_.whole(1, 6) + random_.between(0.0, 1.0);
    z_ = random_.chance(0.6) ? 0.0 : random_.between(0.0, 3.0);
    stiffness_ = random_.log_between(0.1, 1e5);
  }

  void choose_gravity() {
    const double tilt = random_.chance(0.4) ? random_.between(-0.6, 0.6) : 0.0;
    const double g =
        standard_gravity * (random_.chance(0.5) ? 1.0 : random_.log_between(0.1, 10.0));
    scene_.gravity = {g * std::sin(tilt), 0.0, -g * std::cos(tilt)};
  }

  void choose_method() {
    Method& method = scene_.method;
    // usl is left out: it is known to throw points (its strain follows light nodes).
    method.scheme = random_.chance(0.7) ? Scheme::musl : Scheme::usf;
    method.flip = random_.chance(0.4) ? 1.0 : random_.between(0.9, 1.0);
    method.local_damping = random_.chance(0.2) ? random_.between(0.0, 0.5) : 0.0;
    scene_.timing.cfl = random_.between(0.1, 0.9);
  }

  /// A new one; `contrast`: its density by that of the first.
  std::string material(double contrast = 1.0) {
    Material made;
    made.name = "material" + std::to_string(scene_.materials.size());
    made.density = scene_.materials.empty() ? random_.between(500.0, 3000.0)
                                            : contrast * scene_.materials[0].density;
    // By the weight of the first material over the body's height: 1 is squeezed flat.
    const double g = std::hypot(scene_.gravity[0], scene_.gravity[2]);
    const double weight = made.density / contrast * g * height_ * scene_.grid.cell_size;
    made.youngs_modulus = stiffness_ * weight;
    if (contrast != 1.0) made.youngs_modulus *= random_.log_between(0.1, 10.0);
    made.poissons_ratio = random_.between(0.0, 0.49);
    if (!random_.chance(0.25)) made.law = soil(weight);
    scene_.materials.push_back(made);
    return made.name;
  }

  DruckerPrager soil(double weight) {
    DruckerPrager law;
    law.friction_angle = random_.between(0.0, 50.0);
    law.cohesion = random_.chance(0.4)   ? 0.0
                   : random_.chance(0.5) ? random_.log_between(1.0, 1e6)
                                         : weight * random_.log_between(1e-3, 1.0);
    if (random_.chance(0.4))
      law.dilation_angle = random_.between(0.0, std::min(20.0, law.friction_angle));
    law.cone = static_cast<Cone>(random_.whole(0, 2));
    if (random_.chance(0.2)) law.tension_cutoff = random_.between(0.0, law.cohesion);
    law.opening = random_.chance(0.5) ? Opening::forgotten : Opening::remembered;
    return law;
  }

  /// m/s, any direction, up to a part of the last material's wave speed.
  std::array<double, 3> speed(double part_of_wave) {
    const Material& of = scene_.materials.back();
    const double v =
        random_.log_between(1e-3, 1.0) * part_of_wave * std::sqrt(of.youngs_modulus / of.density);
    const double angle = random_.between(-3.14159265358979, 3.14159265358979);
    const double across = scene_.grid.dimension == 3 ? random_.between(-0.5, 0.5) : 0.0;
    return {v * std::cos(angle), v * across, v * std::sin(angle)};
  }

  void add(Shape shape, const std::string& material, std::array<double, 3> velocity = {0, 0, 0}) {
    Region region;
    region.name = "region" + std::to_string(scene_.regions.size());
    region.material = material;
    region.polygon = std::move(shape);
    region.velocity = velocity;
    scene_.regions.push_back(region);
  }

  Wall wall() {
    const double draw = random_.between(0.0, 1.0);
    if (draw < 0.35) return {WallKind::fixed};
    if (draw < 0.6) return {WallKind::symmetry};
    if (draw < 0.9) return {WallKind::friction, random_.between(0.0, 1.0)};
    return {WallKind::free};
  }

  /// Around the body, with some room; the base is closed more often than not.
  void close_grid() {
    double right = 0.0;
    double top = 0.0;
    for (const Region& region : scene_.regions)
      for (const auto& corner : region.polygon) {
        right = std::max(right, corner[0]);
        top = std::max(top, corner[1]);
      }
    cells_ = {std::ceil(right) + (confined_ ? 0 : random_.whole(2, 12)),
              std::ceil(depth_) + (confined_ ? 0 : random_.whole(0, 3)),
              std::ceil(top) + random_.whole(2, 8)};
    auto& walls = scene_.grid.walls;
    for (auto& sides : walls)
      for (Wall& side : sides) side = confined_ ? Wall{WallKind::symmetry} : wall();
    if (random_.chance(0.7)) walls[2][0] = {WallKind::fixed};
    if (random_.chance(0.5)) walls[2][1] = {WallKind::free};
  }

  void scale() {
    Grid& grid = scene_.grid;
    const double h = grid.cell_size;
    for (std::size_t i = 0; i < 3; ++i) grid.upper[i] = grid.lower[i] + h * cells_[i];
    for (Region& region : scene_.regions) {
      for (auto& corner : region.polygon)
        corner = {grid.lower[0] + h * corner[0], grid.lower[2] + h * corner[1]};
      if (grid.dimension == 3)
        region.depth = {grid.lower[1], std::min(grid.lower[1] + h * depth_, grid.upper[1])};
    }
    if (gate_ > 0.0) scene_.gates = {{"gate", 0, grid.lower[0] + h * gate_, 0.0}};
  }

  /// From the number of steps, with the shortest step that a fall through the grid leaves.
  void choose_time() {
    double fastest = 0.0; // wave, m/s
    for (const Material& material : scene_.materials) {
      const auto moduli = ElasticModuli::from(material.youngs_modulus, material.poissons_ratio);
      fastest = std::max(fastest, std::sqrt(moduli.p_wave() / material.density));
    }
    double thrown = 0.0; // m/s
    for (const Region& region : scene_.regions)
      thrown =
          std::max(thrown, std::hypot(region.velocity[0], region.velocity[1], region.velocity[2]));
    const Grid& grid = scene_.grid;
    double fall = 0.0; // m2/s2
    for (const std::size_t i : {0U, 2U})
      fall += std::abs(scene_.gravity[i]) * (grid.upper[i] - grid.lower[i]);
    const double steps = confined_ ? 3000.0 : random_.log_between(200.0, 3000.0);
    const double end = steps * scene_.timing.cfl * grid.cell_size /
                       (fastest + std::sqrt(thrown * thrown + 2.0 * fall));
    scene_.timing.output_interval = end;
    scene_.timing.history_interval = end;
    if (scene_.stages.empty()) scene_.timing.end_time = end;
    for (Stage& stage : scene_.stages) {
      stage.duration *= end;
      for (auto& point : stage.gravity.points) point[0] *= end;
      for (auto& [region, ramp] : stage.body_force)
        for (auto& point : ramp.points) point[0] *= end;
    }
    // The stages' durations may add up to a little less.
    if (!scene_.stages.empty()) scene_.timing.output_interval = 0.5 * end;
    for (Gate& gate : scene_.gates) gate.release_time = end * random_.between(0.1, 0.5);
  }

  Random random_;
  Scene scene_;
  double x_ = 0.0; ///< cells, lower corner of the body
  double z_ = 0.0;
  double width_ = 1.0; ///< cells
  double height_ = 1.0;
  double depth_ = 1.0;
  double stiffness_ = 1.0; ///< Young's modulus by the body's weight per area
  double gate_ = 0.0;      ///< cells; 0: none
  bool confined_ = false;
  std::array<double, 3> cells_ = {};
};

struct Family {
  std::string name;
  void (Draft::*draw)();
};

const std::vector<Family>& families() {
  static const std::vector<Family> all = {{"block", &Draft::block},
                                          {"slope", &Draft::slope},
                                          {"sliver", &Draft::sliver},
                                          {"layers", &Draft::layers},
                                          {"block_on_soil", &Draft::block_on_soil},
                                          {"single_points", &Draft::single_points},
                                          {"thin_layer", &Draft::thin_layer},
                                          {"cell_boundary", &Draft::cell_boundary},
                                          {"gate", &Draft::gate},
                                          {"collision", &Draft::collision},
                                          {"impact", &Draft::impact},
                                          {"loads", &Draft::loads},
                                          {"rest", &Draft::rest},
                                          {"soft", &Draft::soft}};
  return all;
}

} // namespace

const std::vector<std::string>& stress_families() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Family& family : families()) list.push_back(family.name);
    return list;
  }();
  return names;
}

StressScene stress_scene(std::uint64_t seed, std::size_t number) {
  const Family& family = families()[number % families().size()];
  Draft draft(seed, number);
  (draft.*family.draw)();
  Scene scene = draft.finish();
  scene.title = "stress " + family.name + ", scene " + std::to_string(number) + " of seed " +
                std::to_string(seed);
  return {number, family.name, scene};
}

} // namespace scarp::apps
