#include "apps/stress_scenes.hpp"

#include "apps/stress_draft.hpp"

#include <cmath>

namespace scarp::apps {

namespace {

Shape box(double x, double z, double width, double height) {
  return {{x, z}, {x + width, z}, {x + width, z + height}, {x, z + height}};
}

/// Every member function puts the body of one family in.
class Draft : public StressDraft {
 public:
  using StressDraft::StressDraft;

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

StressScene stress_scene(Preset preset, std::uint64_t seed, std::size_t number) {
  const Family& family = families()[number % families().size()];
  Draft draft(preset, seed, number);
  (draft.*family.draw)();
  Scene scene = draft.finish();
  scene.title = "stress " + family.name + ", scene " + std::to_string(number) + " of seed " +
                std::to_string(seed);
  return {number, family.name, scene};
}

} // namespace scarp::apps
