#include "core/fields.hpp"
#include "core/simulation.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/threads.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

using namespace scarp;
using namespace scarp::test;

namespace {

using Fields = std::map<std::string, std::vector<double>>;

Fields all_fields(const Simulation& simulation) {
  Fields fields = {{"positions", simulation.positions()}};
  for (const FieldInfo& info : field_table()) fields[info.name] = simulation.field(info.name);
  return fields;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

double largest_size(const std::vector<double>& a) {
  return largest_difference(a, std::vector<double>(a.size(), 0.0));
}

} // namespace

TEST(Fields, TableAndSizes) {
  const auto simulation = make_simulation(small_pile());
  EXPECT_EQ(simulation->points(), 128U);
  EXPECT_EQ(simulation->dimension(), 2);
  for (const FieldInfo& info : field_table())
    EXPECT_EQ(simulation->field(info.name).size(), 128U * static_cast<std::size_t>(info.components))
        << info.name;
  try {
    simulation->field("presure");
    ADD_FAILURE() << "no such field";
  } catch (const SetupError& error) {
    EXPECT_NE(std::string(error.what()).find("'presure'"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("mean_stress"), std::string::npos)
        << "names what there is";
  }
}

TEST(MakeSimulation, RefusesOtherDimensions) {
  Scene scene = small_pile();
  scene.grid.dimension = 1;
  EXPECT_THROW(make_simulation(scene), SetupError);
}

/// mean stress and sqrt(J2) are those of the stress field; density times volume is the mass.
TEST(Fields, AgreeWithEachOther) {
  const auto simulation = make_simulation(small_pile());
  run_until(*simulation, 0.02);
  const auto stress = simulation->field("stress");
  const auto mean = simulation->field("mean_stress");
  const auto deviatoric = simulation->field("deviatoric_stress");
  const auto displacement = simulation->field("displacement");
  const auto start = make_simulation(small_pile())->positions();
  const auto now = simulation->positions();
  EXPECT_GT(largest_size(mean), 100.0) << "there is something to compare";
  for (std::size_t p = 0; p < simulation->points(); ++p) {
    const double* s = &stress[6 * p]; // xx yy zz xy yz xz
    EXPECT_NEAR(mean[p], (s[0] + s[1] + s[2]) / 3.0, 1e-10);
    const double J2 = ((s[0] - s[1]) * (s[0] - s[1]) + (s[1] - s[2]) * (s[1] - s[2]) +
                       (s[2] - s[0]) * (s[2] - s[0])) /
                          6.0 +
                      s[5] * s[5];
    EXPECT_NEAR(deviatoric[p], std::sqrt(J2), 1e-9);
    EXPECT_EQ(s[3], 0.0);
    EXPECT_EQ(s[4], 0.0);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(displacement[3 * p + i], now[3 * p + i] - start[3 * p + i]);
  }
  EXPECT_NEAR(sum(masses(*simulation)), 2650.0 * 0.04 * 0.02, 1e-12);
}

/// Nearest to a place at the start, wherever the points are by now.
TEST(NearestPoint, IsThatAtTimeZero) {
  const auto simulation = make_simulation(free_block({1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}));
  const std::size_t before = simulation->nearest_point({0.0, 0.0, 0.0});
  run_until(*simulation, 0.2);
  EXPECT_EQ(simulation->nearest_point({0.0, 0.0, 0.0}), before);
  EXPECT_NE(simulation->nearest_point({0.2, 0.0, 0.0}), before);
}

/// Without gravity and velocity nothing ever moves: exact zeros.
TEST(Simulation, NothingMovesWithoutCause) {
  for (const Scheme scheme : {Scheme::usf, Scheme::usl, Scheme::musl}) {
    Scene scene = small_pile();
    scene.gravity = {0.0, 0.0, 0.0};
    scene.method.scheme = scheme;
    const auto simulation = make_simulation(scene);
    const auto start = simulation->positions();
    for (int step = 0; step < 20; ++step) simulation->step(1.0);
    EXPECT_TRUE(same_bits(simulation->positions(), start));
    for (const char* name : {"displacement", "velocity", "stress", "equivalent_plastic_strain"})
      EXPECT_EQ(largest_size(simulation->field(name)), 0.0) << name;
    EXPECT_EQ(simulation->energies().kinetic, 0.0);
    EXPECT_EQ(simulation->energies().scheme_loss, 0.0);
  }
}

/// n steps dt of symplectic Euler under g from v0:
///   v = v0 + n dt g,  x = x0 + n dt v0 + dt^2 g n (n + 1)/2.
/// The block crosses cells on its way; a uniform motion strains nothing, so this is exact to
/// rounding.
TEST(Simulation, FreeFallIsExact) {
  for (const Scheme scheme : {Scheme::usf, Scheme::usl, Scheme::musl})
    for (const double flip : {1.0, 0.95}) {
      Scene scene = free_block({0.7, 0.0, 1.3}, {0.5, 0.0, -9.81});
      scene.method.scheme = scheme;
      scene.method.flip = flip;
      const double dt = scene.timing.max_time_step = 0.0009765625; // 2^-10 s
      const auto simulation = make_simulation(scene);
      const auto start = simulation->positions();
      const int n = 512;
      for (int step = 0; step < n; ++step) ASSERT_EQ(simulation->step(1.0), dt);
      const double t = n * dt, t2 = 0.5 * dt * dt * n * (n + 1);
      const auto x = simulation->positions();
      const auto v = simulation->field("velocity");
      for (std::size_t p = 0; p < simulation->points(); ++p) {
        EXPECT_NEAR(x[3 * p], start[3 * p] + 0.7 * t + 0.5 * t2, 1e-12);
        EXPECT_NEAR(x[3 * p + 2], start[3 * p + 2] + 1.3 * t - 9.81 * t2, 1e-12);
        EXPECT_NEAR(v[3 * p], 0.7 + 0.5 * t, 1e-12);
        EXPECT_NEAR(v[3 * p + 2], 1.3 - 9.81 * t, 1e-12);
        EXPECT_EQ(x[3 * p + 1], 0.0);
      }
      EXPECT_LT(largest_size(simulation->field("stress")), 1e-9); // of 1 kPa
    }
}

TEST(Simulation, FreeFallIsExactIn3d) {
  Scene scene = free_block({0.7, -0.4, 1.3}, {0.5, 0.25, -9.81});
  scene.grid = grid_3d(0.1, {-1.0, -0.5, -1.0}, {1.0, 0.5, 1.0});
  scene.regions[0].depth = {-0.1, 0.2};
  const double dt = scene.timing.max_time_step = 0.0009765625;
  const auto simulation = make_simulation(scene);
  const auto start = simulation->positions();
  const int n = 256;
  for (int step = 0; step < n; ++step) ASSERT_EQ(simulation->step(1.0), dt);
  const double t = n * dt, t2 = 0.5 * dt * dt * n * (n + 1);
  const auto x = simulation->positions();
  for (std::size_t p = 0; p < simulation->points(); ++p)
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(x[3 * p + i],
                  start[3 * p + i] + scene.regions[0].velocity[i] * t + scene.gravity[i] * t2,
                  1e-12);
}

/// USF, USL and MUSL are three different methods: after 20 ms of collapse their points are at
/// different places, and stay close, since all three approximate the same equations.
TEST(Simulation, SchemesDiffer) {
  std::vector<std::vector<double>> positions;
  for (const Scheme scheme : {Scheme::usf, Scheme::usl, Scheme::musl}) {
    Scene scene = small_pile();
    scene.method.scheme = scheme;
    const auto simulation = make_simulation(scene);
    run_until(*simulation, 0.02);
    positions.push_back(simulation->positions());
  }
  for (const auto& [a, b] : {std::pair{0, 1}, {0, 2}, {1, 2}}) {
    const double difference = largest_difference(positions[static_cast<std::size_t>(a)],
                                                 positions[static_cast<std::size_t>(b)]);
    EXPECT_GT(difference, 1e-7);
    EXPECT_LT(difference, 2e-3);
  }
}

TEST(Simulation, BitwiseEqualForAnyNumberOfThreads) {
  for (const Scheme scheme : {Scheme::usf, Scheme::usl, Scheme::musl}) {
    Scene scene = pile(0.08, 0.04, 0.005, 0.2, 0.06);
    scene.method.scheme = scheme;
    scene.method.flip = 0.99;
    scene.method.local_damping = 0.1;
    scene.grid.walls[2][0] = {WallKind::friction, 0.3};
    Fields reference;
    Energies energies;
    for (const int count : {1, 2, 3}) {
      const Threads threads(count);
      const auto simulation = make_simulation(scene);
      for (int step = 0; step < 200; ++step) simulation->step(1.0);
      const Fields fields = all_fields(*simulation);
      if (count == 1) {
        reference = fields;
        energies = simulation->energies();
        EXPECT_GT(largest_size(fields.at("displacement")), 1e-4) << "it has moved";
        continue;
      }
      for (const auto& [name, values] : fields)
        EXPECT_TRUE(same_bits(values, reference.at(name)))
            << name << " with " << count << " threads";
      EXPECT_EQ(simulation->energies().damping, energies.damping);
      EXPECT_EQ(simulation->energies().wall_friction, energies.wall_friction);
    }
  }
}

/// A second run is the first, to the bit.
TEST(Simulation, RepeatsItself) {
  Fields first;
  for (int run = 0; run < 2; ++run) {
    const auto simulation = make_simulation(small_pile());
    run_until(*simulation, 0.02);
    const Fields fields = all_fields(*simulation);
    if (run == 0) first = fields;
    for (const auto& [name, values] : fields)
      EXPECT_TRUE(same_bits(values, first.at(name))) << name;
  }
}

/// One layer of cells between symmetry planes is plane strain: mirrored points front and back,
/// whose shape functions add up to those of the plane.  The sums differ in the order and number of
/// their terms, so only by rounding: measured 1e-15 of the largest value after 300 steps, 1e-12
/// allowed.  (No local damping here: the sign of a velocity that is zero but for rounding makes a
/// difference of 5e-6 within 3 steps.)
TEST(Simulation, OneCellDeepIsPlaneStrain) {
  for (const Scheme scheme : {Scheme::usf, Scheme::usl, Scheme::musl}) {
    Scene plane = small_pile();
    plane.method.scheme = scheme;
    plane.grid.walls[2][0] = {WallKind::friction, 0.3};
    const double h = plane.grid.cell_size;
    Scene full = plane;
    full.grid.dimension = 3;
    full.grid.lower[1] = 0.02;
    full.grid.upper[1] = 0.02 + h;
    full.grid.walls[1][0].kind = full.grid.walls[1][1].kind = WallKind::symmetry;
    full.regions[0].depth = {0.02, 0.02 + h};

    const auto two = make_simulation(plane);
    const auto three = make_simulation(full);
    ASSERT_EQ(three->points(), 2 * two->points());
    for (int step = 0; step < 300; ++step)
      ASSERT_NEAR(two->step(1.0) / three->step(1.0), 1.0, 1e-12);
    EXPECT_GT(largest_size(two->field("displacement")), 1e-4) << "it has moved";
    EXPECT_GT(largest_size(two->field("equivalent_plastic_strain")), 1e-3) << "and yielded";

    const auto x2 = two->positions();
    const auto x3 = three->positions();
    for (const char* name :
         {"displacement", "velocity", "stress", "equivalent_plastic_strain", "density"}) {
      const auto a = two->field(name);
      const auto b = three->field(name);
      const std::size_t components = a.size() / two->points();
      const double scale = largest_size(a);
      double worst = 0.0;
      // In 3-D the order is x, then y, then z: each row of x comes twice, front and back.
      const std::size_t row = 16; // 40 mm on a lattice of 2.5 mm
      for (std::size_t p = 0; p < three->points(); ++p) {
        const std::size_t q = p / (2 * row) * row + p % row;
        for (std::size_t c = 0; c < components; ++c)
          worst = std::max(worst, std::abs(b[components * p + c] - a[components * q + c]));
        EXPECT_NEAR(x3[3 * p], x2[3 * q], 1e-6) << "the same point";
      }
      EXPECT_LT(worst / scale, 1e-12) << name;
    }
    const Energies e2 = two->energies(), e3 = three->energies();
    EXPECT_NEAR(e3.kinetic / h, e2.kinetic, 1e-12 * e2.gravity_work);
    EXPECT_NEAR(e3.strain / h, e2.strain, 1e-12 * e2.gravity_work);
    EXPECT_NEAR(e3.plastic / h, e2.plastic, 1e-12 * e2.gravity_work);
    EXPECT_NEAR(e3.wall_friction / h, e2.wall_friction, 1e-12 * e2.gravity_work);
    EXPECT_NEAR(e3.gravity_work / h, e2.gravity_work, 1e-12 * e2.gravity_work);
  }
}

/// Bodies that do not touch do not know of each other, whatever their materials: each moves as it
/// does alone.  To rounding only: within a cell points are added up in the order of their rows, and
/// when these are put in order depends on all points.
TEST(Simulation, MaterialsAreKeptApart) {
  DruckerPrager soft;
  soft.cohesion = 50.0;
  soft.friction_angle = 25.0;
  Scene both;
  both.grid = grid_2d(0.05, {0.0, 0.0}, {2.0, 0.5});
  both.grid.walls[2][0].kind = WallKind::fixed;
  both.materials = {elastic("stone", 2500.0, 5e5, 0.2), {"soil", 1800.0, 2e5, 0.3, soft}};
  both.regions = {box("left", "stone", {0.3, 0.0}, {0.6, 0.3}, {0.2, 0.0, 0.0}),
                  box("right", "soil", {1.2, 0.0}, {1.5, 0.3})};
  both.timing.max_time_step = 5e-4; // the same for all three
  const auto together = make_simulation(both);
  for (int step = 0; step < 200; ++step) ASSERT_EQ(together->step(1.0), 5e-4);

  std::size_t offset = 0;
  for (std::size_t r = 0; r < 2; ++r) {
    Scene one = both;
    one.regions = {both.regions[r]};
    const auto alone = make_simulation(one);
    for (int step = 0; step < 200; ++step) ASSERT_EQ(alone->step(1.0), 5e-4);
    for (const char* name :
         {"displacement", "velocity", "stress", "equivalent_plastic_strain", "density"}) {
      const auto a = alone->field(name);
      const auto b = together->field(name);
      const auto begin =
          b.begin() + static_cast<std::ptrdiff_t>(offset * (a.size() / alone->points()));
      const std::vector<double> part(begin, begin + static_cast<std::ptrdiff_t>(a.size()));
      EXPECT_LT(largest_difference(a, part), 1e-10 * largest_size(a) + 1e-300) << name;
    }
    const auto plastic = alone->field("equivalent_plastic_strain");
    EXPECT_EQ(largest_size(plastic) > 1e-3, r == 1) << "only the soil yields";
    offset += alone->points();
  }
  const auto region = together->field("region");
  EXPECT_EQ(std::count(region.begin(), region.end(), 0.0), 144);
  EXPECT_EQ(std::count(region.begin(), region.end(), 1.0), 144);
}

/// The step is the CFL part of h / (c + v), c the fastest wave of all materials in use, v the
/// fastest point.
TEST(Simulation, StableTimeStep) {
  Scene scene = free_block({3.0, 0.0, -4.0}, {0.0, 0.0, 0.0});
  scene.materials = {elastic("foam", 1000.0, 1e3, 0.0), elastic("stone", 1000.0, 4e3, 0.0),
                     elastic("nowhere", 1000.0, 9e3, 0.0)};
  scene.regions.push_back(box("pebble", "stone", {1.0, 0.5}, {1.05, 0.55}));
  scene.timing.cfl = 0.5; // c = sqrt(E / rho) at nu = 0: 1 and 2 m/s
  const auto simulation = make_simulation(scene);
  EXPECT_NEAR(simulation->stable_time_step(), 0.5 * 0.1 / (2.0 + 5.0), 1e-16);
  EXPECT_NEAR(simulation->step(1.0), 0.5 * 0.1 / 7.0, 1e-16);
  scene.timing.max_time_step = 1e-3;
  EXPECT_EQ(make_simulation(scene)->step(1.0), 1e-3);
}

/// Every frame is met to the bit, no step goes beyond it, and none before it is a scrap: the last
/// two share what is left.
TEST(Simulation, FramesAreMetExactly) {
  const auto simulation = make_simulation(small_pile());
  const double stable = simulation->stable_time_step();
  for (int frame = 1; frame <= 60; ++frame) {
    const double due = frame * 0.00037;
    while (simulation->time() < due) {
      const double dt = simulation->step(due);
      EXPECT_LE(dt, stable * 1.01);
      EXPECT_GT(dt, 0.3 * stable);
      ASSERT_LE(simulation->time(), due);
    }
    EXPECT_EQ(simulation->time(), due);
  }
  EXPECT_GE(simulation->steps(), 120);
}

/// A point thrown through a free side.
TEST(RunErrors, LeavingTheGrid) {
  Scene scene = free_block({0.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
  scene.regions.push_back(box("shot", "foam", {1.0, 0.5}, {1.05, 0.55}, {5.0, 0.0, 0.0}));
  const auto simulation = make_simulation(scene);
  const std::size_t shot = simulation->points() - 1; // one lattice square: the last point
  ASSERT_EQ(shot, simulation->nearest_point({1.025, 0.0, 0.525}));
  double last_x = 0.0, last_time = 0.0;
  try {
    for (;;) {
      last_x = simulation->positions()[3 * shot];
      last_time = simulation->time();
      ASSERT_LT(last_time, 0.3) << "1 m at 5 m/s takes 0.2 s";
      simulation->step(1.0);
    }
  } catch (const RunError& error) {
    EXPECT_EQ(error.point(), shot);
    EXPECT_EQ(error.step(), simulation->steps()) << "the step that failed";
    EXPECT_EQ(error.time(), simulation->time());
    EXPECT_GT(error.time(), last_time);
    EXPECT_NEAR(error.time(), 0.195, 0.01);
    EXPECT_EQ(error.position()[0], last_x) << "the last good position";
    EXPECT_LT(error.position()[0], 2.0);
    EXPECT_NEAR(error.position()[2], 0.525, 1e-12);
    const std::string text = error.what();
    for (const std::string& part : {"step " + std::to_string(error.step()), std::string("time 0.1"),
                                    "point " + std::to_string(shot), std::string("leaves the grid"),
                                    std::string("try: enlarge the grid")})
      EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' in: " << text;
    EXPECT_EQ(simulation->positions()[3 * shot], last_x)
        << "the state keeps the last good positions";
    return;
  }
}

TEST(RunErrors, NotANumber) {
  for (const double gravity :
       {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    const auto simulation = make_simulation(free_block({0.0, 0.0, 0.0}, {0.0, 0.0, gravity}));
    const auto start = simulation->positions();
    try {
      simulation->step(1.0);
      ADD_FAILURE() << "gravity " << gravity << " went through";
    } catch (const RunError& error) {
      EXPECT_EQ(error.step(), 1);
      EXPECT_EQ(error.time(), simulation->time());
      EXPECT_EQ(error.point(), 0U) << "the first in the order of creation";
      EXPECT_NE(std::string(error.what()).find("no number"), std::string::npos) << error.what();
    }
    EXPECT_TRUE(same_bits(simulation->positions(), start));
  }
}
