#include "core/fields.hpp"
#include "io/text.hpp"

#include "io_scene_problems.hpp"

#include <ostream>

using namespace scarp;
using namespace scarp::test;

namespace {

struct Case {
  std::string what;
  std::string old_text;
  std::string new_text;
  std::vector<std::string> problems; ///< without the name of the file

  friend void PrintTo(const Case& c, std::ostream* stream) { *stream << c.what; }
};

class BadScene : public testing::TestWithParam<Case> {};

const std::string vector_m = "must be [x, z] (3-D: [x, y, z]), finite numbers in m";
const std::string wall =
    "must be 'fixed', 'symmetry', 'free' or { kind = 'friction', coefficient = "
    "NUMBER >= 0 }";
const std::string name_text = "must be a word of letters, digits, '_' and '-', no digit first";

std::string fields() {
  std::vector<std::string> names;
  for (const FieldInfo& field : field_table()) names.push_back(field.name);
  return "must be a list of different words out of " + io::quoted_list(names, "and");
}

const Case cases[] = {
    {"UnknownTopKey",
     "title",
     "titel",
     {"1:1: titel: is unknown; must be one of 'grid', 'walls', 'time', 'method', 'material', "
      "'region', 'gate', 'stage', 'monitor', 'output', 'title' and 'gravity_m_s2' (did you mean "
      "'title'?)"}},
    {"UnknownSection",
     "[method]\nscheme = \"musl\"",
     "[methods]",
     {"12:2: methods: is unknown; must be one of 'grid', 'walls', 'time', 'method', 'material', "
      "'region', 'gate', 'stage', 'monitor', 'output', 'title' and 'gravity_m_s2' (did you mean "
      "'method'?)"}},
    {"UnknownKey",
     "lower_m =",
     "points = 3\nlower_m =",
     {"5:1: grid.points: is unknown; must be one of 'dimension', 'cell_size_m', 'lower_m', "
      "'upper_m' and 'points_per_cell' (did you mean 'points_per_cell'?)"}},
    {"MissingUnit",
     "cell_size_m",
     "cell_size",
     {"3:1: grid.cell_size_m: is missing; must be a number > 0, in m",
      "4:1: grid.cell_size: is unknown; must be one of 'dimension', 'cell_size_m', 'lower_m', "
      "'upper_m' and 'points_per_cell' (did you mean 'cell_size_m'?)"}},
    {"MissingSection",
     "[time]\nend_s = 1\noutput_interval_s = 0.5\n",
     "",
     {"1:1: time: is missing; must be a section, headed [time]"}},
    {"MissingRegion",
     "[[region]]\nname = \"pile\"\nmaterial = \"soil\"\npolygon_m = [[0, 0], [1, 0], [0, 1]]\n",
     "",
     {"1:1: region: is missing; must be at least one section, headed [[region]]"}},
    {"ListInsteadOfSection",
     "[time]",
     "[[time]]",
     {"9:1: time: is an array of 1; must be one section, headed [time]"}},
    {"SectionInsteadOfList",
     "[[gate]]",
     "[gate]",
     {"32:1: gate: is a table; must be a list of sections, each headed [[gate]]"}},
    {"StringForNumber",
     "cell_size_m = 0.1",
     "cell_size_m = \"0.1\"",
     {"4:15: grid.cell_size_m: is '0.1'; must be a number > 0, in m"}},
    {"NumberForString", "title = \"good\"", "title = 3", {"1:9: title: is 3; must be a string"}},
    {"NumberForWord",
     "scheme = \"musl\"",
     "scheme = 2",
     {"13:10: method.scheme: is 2; must be 'usf', 'usl' or 'musl'"}},
    {"WrongWord",
     "scheme = \"musl\"",
     "scheme = \"muls\"",
     {"13:10: method.scheme: is 'muls'; must be 'usf', 'usl' or 'musl' (did you mean 'musl'?)"}},
    {"AffineAndLinear",
     "scheme = \"musl\"",
     "shape = \"linear\"\ntransfer = \"apic\"",
     {"14:12: method.transfer: is affine with linear shape functions, whose gradients jump between "
      "cells: slides blow up; must be 'flip' unless method.shape is 'bspline' or 'gimp'"}},
    {"DateForNumber",
     "end_s = 1",
     "end_s = 2020-01-01",
     {"10:9: time.end_s: is a date or time; must be a number > 0, in s"}},
    {"BooleanForNumber",
     "end_s = 1",
     "end_s = true",
     {"10:9: time.end_s: is true; must be a number > 0, in s"}},
    {"ZeroCell",
     "cell_size_m = 0.1",
     "cell_size_m = 0",
     {"4:15: grid.cell_size_m: is 0; must be a number > 0, in m"}},
    {"InfiniteCell",
     "cell_size_m = 0.1",
     "cell_size_m = inf",
     {"4:15: grid.cell_size_m: is inf; must be a number > 0, in m"}},
    {"NanCorner",
     "lower_m = [0, 0]",
     "lower_m = [0, nan]",
     {"5:11: grid.lower_m: holds nan; " + vector_m}},
    {"WrongLength",
     "lower_m = [0, 0]",
     "lower_m = [0, 0, 0]",
     {"5:11: grid.lower_m: is an array of 3; " + vector_m}},
    {"WrongDimension",
     "[grid]",
     "[grid]\ndimension = 4",
     {"4:13: grid.dimension: is 4; must be a whole number from 2 to 3"}},
    {"RealDimension",
     "[grid]",
     "[grid]\ndimension = 2.0",
     {"4:13: grid.dimension: is 2; must be a whole number from 2 to 3"}},
    {"UpperBelowLower",
     "upper_m = [2, 1]",
     "upper_m = [2, 0]",
     {"6:11: grid.upper_m: is not above the lower corner: z runs from 0 to 0; must be above "
      "grid.lower_m along every axis"}},
    {"PartOfACell",
     "upper_m = [2, 1]",
     "upper_m = [2.04, 1]",
     {"6:11: grid.upper_m: leaves 20.4 cells of 0.1 m: x runs from 0 to 2.04; must be a whole "
      "number of cells above grid.lower_m"}},
    {"TooManyCells",
     "cell_size_m = 0.1",
     "cell_size_m = 1e-9",
     {"4:15: grid.cell_size_m: makes 2e+18 cells; must make at most 1e+09"}},
    {"TooManyPoints",
     "cell_size_m = 0.1",
     "cell_size_m = 0.0001\npoints_per_cell = 10",
     {"5:19: grid.points_per_cell: makes about 5e+09 points; must make at most 1e+09"}},
    {"PointsPerCell",
     "cell_size_m = 0.1",
     "cell_size_m = 0.1\npoints_per_cell = 0",
     {"5:19: grid.points_per_cell: is 0; must be a whole number from 1 to 10"}},
    {"GravityAlongY",
     "[0, -9.81]",
     "[0, 1, -9.81]",
     {"2:16: gravity_m_s2: has a y part, which plane strain has not; must be [x, z] (3-D: [x, y, "
      "z]), finite numbers in m/s2"}},
    {"WallWord",
     "z_lower = \"fixed\"",
     "z_lower = \"fixd\"",
     {"8:11: walls.z_lower: is 'fixd'; " + wall + " (did you mean 'fixed'?)"}},
    {"WallInYOfPlaneStrain",
     "z_lower = \"fixed\"",
     "y_lower = \"fixed\"",
     {"8:11: walls.y_lower: is not used here; must be left out unless dimension = 3"}},
    {"FrictionWithoutCoefficient",
     "z_lower = \"fixed\"",
     "z_lower = \"friction\"",
     {"8:11: walls.z_lower: is 'friction' without a coefficient; " + wall}},
    {"CoefficientWithoutFriction",
     "z_lower = \"fixed\"",
     "z_lower = { kind = \"fixed\", coefficient = 1 }",
     {"8:11: walls.z_lower: is 'fixed' with a coefficient, which only 'friction' has; " + wall}},
    {"NegativeFriction",
     "z_lower = \"fixed\"",
     "z_lower = { kind = \"friction\", coefficient = -1 }",
     {"8:11: walls.z_lower: has the coefficient -1; " + wall + " (it must be a number >= 0)"}},
    {"MisspeltFriction",
     "z_lower = \"fixed\"",
     "z_lower = { kind = \"friction\", coeficient = 1 }",
     {"8:11: walls.z_lower: holds an unknown key 'coeficient'; " + wall +
      " (did you mean 'coefficient'?)"}},
    {"NegativeEnd",
     "end_s = 1",
     "end_s = -1",
     {"10:9: time.end_s: is -1; must be a number > 0, in s"}},
    {"ZeroInterval",
     "output_interval_s = 0.5",
     "output_interval_s = 0",
     {"11:21: time.output_interval_s: is 0; must be a number > 0, in s"}},
    {"IntervalBeyondEnd",
     "output_interval_s = 0.5",
     "output_interval_s = 2",
     {"11:21: time.output_interval_s: is 2; must be at most time.end_s, 1"}},
    {"TooManyFrames",
     "output_interval_s = 0.5",
     "output_interval_s = 1e-9",
     {"11:21: time.output_interval_s: makes 1e+09 frames; must make at most 1e+06"}},
    {"Cfl",
     "end_s = 1",
     "end_s = 1\ncfl = 1.5",
     {"11:7: time.cfl: is 1.5; must be a number > 0 and <= 1"}},
    {"MaxStep",
     "end_s = 1",
     "end_s = 1\nmax_step_s = 0",
     {"11:14: time.max_step_s: is 0; must be a number > 0, in s, or inf (no limit)"}},
    {"RestWithoutDuration",
     "end_s = 1",
     "end_s = 1\nrest_energy_fraction = 0.1",
     {"9:1: time.rest_duration_s: is 0; must be > 0 where time.rest_energy_fraction is, as every "
      "scene starts at rest"}},
    {"Flip",
     "scheme = \"musl\"",
     "flip = -0.1",
     {"13:8: method.flip: is -0.1; must be a number >= 0 and <= 1"}},
    {"Damping",
     "scheme = \"musl\"",
     "local_damping = 1",
     {"13:17: method.local_damping: is 1; must be a number >= 0 and < 1"}},
    {"MissingLaw",
     "law = \"drucker_prager\"\n",
     "",
     {"14:1: material.soil.law: is missing; must be 'linear_elastic' or 'drucker_prager'"}},
    {"WrongLaw",
     "\"drucker_prager\"",
     "\"drucker-prager\"",
     {"16:7: material.soil.law: is 'drucker-prager'; must be 'linear_elastic' or 'drucker_prager' "
      "(did you mean 'drucker_prager'?)"}},
    {"OptionOfTheOtherLaw",
     "law = \"drucker_prager\"",
     "law = \"linear_elastic\"",
     {"20:15: material.soil.cohesion_Pa: is not used here; must be left out unless law = "
      "\"drucker_prager\"",
      "21:22: material.soil.friction_angle_deg: is not used here; must be left out unless law = "
      "\"drucker_prager\""}},
    {"MissingLawOption",
     "cohesion_Pa = 100\n",
     "",
     {"14:1: material.soil.cohesion_Pa: is missing; must be a number >= 0, in Pa"}},
    {"ZeroDensity",
     "density_kg_m3 = 2000\npoissons_ratio = 0.3\nyoungs_modulus_Pa = 1e6\ncohesion",
     "density_kg_m3 = 0\npoissons_ratio = 0.3\nyoungs_modulus_Pa = -1\ncohesion",
     {"17:17: material.soil.density_kg_m3: is 0; must be a number > 0, in kg/m3",
      "19:21: material.soil.youngs_modulus_Pa: is -1; must be a number > 0, in Pa"}},
    {"Incompressible",
     "poissons_ratio = 0.3",
     "poissons_ratio = 0.5",
     {"18:18: material.soil.poissons_ratio: is 0.5; must be a number > -1 and < 0.5 (0.5 is "
      "incompressible: take 0.49)"}},
    {"NoStiffness",
     "youngs_modulus_Pa = 1e6\ncohesion",
     "cohesion",
     {"14:1: material.soil.youngs_modulus_Pa: is missing; must be a number > 0, in Pa; "
      "'bulk_modulus_Pa' may replace it"}},
    {"TwoStiffnesses",
     "youngs_modulus_Pa = 1e6",
     "youngs_modulus_Pa = 1e6\nbulk_modulus_Pa = 1e6",
     {"20:19: material.soil.bulk_modulus_Pa: is given besides 'youngs_modulus_Pa'; must be left "
      "out, or replace it"}},
    {"NegativeBulkModulus",
     "youngs_modulus_Pa = 1e6",
     "bulk_modulus_Pa = -1e6",
     {"19:19: material.soil.bulk_modulus_Pa: is -1000000; must be a number > 0, in Pa"}},
    {"FrictionAngle",
     "friction_angle_deg = 25",
     "friction_angle_deg = 90",
     {"21:22: material.soil.friction_angle_deg: is 90; must be a number >= 0 and < 90, in deg"}},
    {"DilationAboveFriction",
     "friction_angle_deg = 25",
     "friction_angle_deg = 25\ndilation_angle_deg = 30",
     {"22:22: material.soil.dilation_angle_deg: is 30; must be at most the friction angle, 25"}},
    {"ResidualWithoutStrain",
     "friction_angle_deg = 25",
     "friction_angle_deg = 25\nresidual_friction_angle_deg = 20",
     {"22:31: material.soil.residual_friction_angle_deg: has no effect without "
      "residual_plastic_strain, the strain at which it holds"}},
    {"ResidualBeforePeak",
     "friction_angle_deg = 25",
     "friction_angle_deg = 25\nresidual_plastic_strain = 0.1\npeak_plastic_strain = 0.2",
     {"22:27: material.soil.residual_plastic_strain: is 0.1; must be above peak_plastic_strain, "
      "0.2"}},
    {"ResidualDilationAboveFriction",
     "friction_angle_deg = 25",
     "friction_angle_deg = 25\nresidual_plastic_strain = 0.1\nresidual_dilation_angle_deg = 26",
     {"23:31: material.soil.residual_dilation_angle_deg: leaves a residual dilation angle of 26 "
      "and a residual friction angle of 25; dilation must be at most friction"}},
    {"RateWithoutGrains",
     "friction_angle_deg = 25",
     "friction_angle_deg = 25\nrate_strengthening = 1",
     {"22:22: material.soil.rate_strengthening: has no effect without grain_diameter_m, the "
      "diameter of the grains"}},
    {"LimitWithoutRate",
     "friction_angle_deg = 25",
     "friction_angle_deg = 25\nrate_strengthening_limit = 0.28",
     {"22:28: material.soil.rate_strengthening_limit: has no effect without rate_strengthening"}},
    {"NotAName",
     "name = \"soil\"",
     "name = \"1 soil\"",
     {"15:8: material.0.name: is '1 soil'; " + name_text}},
    {"MissingName", "name = \"door\"\n", "", {"32:1: gate.0.name: is missing; " + name_text}},
    {"DuplicateName",
     "name = \"rock\"",
     "name = \"soil\"",
     {"23:8: material.1.name: is 'soil', as that of material.0; must be the only one of its "
      "name"}},
    {"UnknownMaterial",
     "material = \"soil\"",
     "material = \"siol\"",
     {"30:12: region.pile.material: is 'siol'; must be the name of a [[material]]: 'soil' or "
      "'rock' (did you mean 'soil'?)"}},
    {"NoShape",
     "polygon_m = [[0, 0], [1, 0], [0, 1]]\n",
     "",
     {"28:1: region.pile.polygon_m: is missing; must be at least three corners [[x, z], [x, z], "
      "[x, z], ...], finite numbers in m; 'box_m' may replace it"}},
    {"TwoCorners",
     "[[0, 0], [1, 0], [0, 1]]",
     "[[0, 0], [1, 0]]",
     {"31:13: region.pile.polygon_m: is an array of 2; must be at least three corners [[x, z], [x, "
      "z], [x, z], ...], finite numbers in m"}},
    {"CornerOfThree",
     "[[0, 0], [1, 0], [0, 1]]",
     "[[0, 0], [1, 0], [0, 1, 2]]",
     {"31:13: region.pile.polygon_m: has a corner 2 that is an array of 3; must be at least three "
      "corners [[x, z], [x, z], [x, z], ...], finite numbers in m"}},
    {"FlatPolygon",
     "[[0, 0], [1, 0], [0, 1]]",
     "[[0, 0], [1, 0], [0.5, 0]]",
     {"31:13: region.pile.polygon_m: has no area; must enclose some"}},
    {"RepeatedCorner",
     "[[0, 0], [1, 0], [0, 1]]",
     "[[0, 0], [1, 0], [0, 1], [0, 0]]",
     {"31:13: region.pile.polygon_m: ends with its first corner; must name every corner once"}},
    {"BowTie",
     "[[0, 0], [1, 0], [0, 1]]",
     "[[0, 0], [1, 1], [1, 0], [0, 1]]",
     {"31:13: region.pile.polygon_m: crosses or touches itself: edges 0 and 2, counted from 0; "
      "must be a simple polygon"}},
    {"RegionOutside",
     "[[0, 0], [1, 0], [0, 1]]",
     "[[0, 0], [3, 0], [0, 1]]",
     {"31:13: region.pile.polygon_m: has the corner [3, 0] outside the grid, where x runs from 0 "
      "to 2 and z runs from 0 to 1; must lie inside"}},
    {"BoxOutside",
     "polygon_m = [[0, 0], [1, 0], [0, 1]]",
     "box_m = [[0, 0], [1, 1.5]]",
     {"31:9: region.pile.box_m: has the corner [1, 1.5] outside the grid, where x runs from 0 to 2 "
      "and z runs from 0 to 1; must lie inside"}},
    {"EmptyBox",
     "polygon_m = [[0, 0], [1, 0], [0, 1]]",
     "box_m = [[0, 1], [1, 1]]",
     {"31:9: region.pile.box_m: is empty: z runs from 1 to 1; must be two corners [[x, z], [x, z]] "
      "(3-D: [[x, y, z], [x, y, z]]), the lower first, finite numbers in m"}},
    {"BoxAndPolygon",
     "polygon_m",
     "box_m = [[0, 0], [1, 1]]\npolygon_m",
     {"31:9: region.pile.box_m: is given besides 'polygon_m'; must be left out, or replace it"}},
    {"DepthInPlaneStrain",
     "polygon_m",
     "depth_m = [0, 1]\npolygon_m",
     {"31:11: region.pile.depth_m: is not used here; must be left out unless dimension = 3"}},
    {"GateAlongY",
     "name = \"door\"",
     "name = \"door\"\naxis = \"y\"",
     {"34:8: gate.door.axis: is 'y', which plane strain has not; must be 'x' or 'z'"}},
    {"GateOffPlane",
     "position_m = 1\n",
     "position_m = 1.04\n",
     {"34:14: gate.door.position_m: is 1.04, between two grid planes; must lie on one, such as "
      "1"}},
    {"GateOutside",
     "position_m = 1\n",
     "position_m = 7\n",
     {"34:14: gate.door.position_m: is 7, outside the grid, where x runs from 0 to 2; must lie "
      "inside"}},
    {"GateNeverReleased",
     "release_time_s = 0.1",
     "release_time_s = inf",
     {"35:18: gate.door.release_time_s: is inf; must be a number >= 0, in s"}},
    {"MonitorOutside",
     "position_m = [0.5, 0.5]",
     "position_m = [0.5, -0.5]",
     {"38:14: monitor.A.position_m: has z = -0.5, outside the grid, where z runs from 0 to 1; must "
      "lie inside"}},
    {"MonitorInTheAir",
     "position_m = [0.5, 0.5]",
     "position_m = [1.5, 0.5]",
     {"38:14: monitor.A.position_m: lies 0.7071 m outside the body; must lie in a region, or "
      "within "
      "a cell of one"}},
    {"UnknownFrontRegion",
     "[\"velocity\"]",
     "[\"velocity\"]\nfront_regions = [\"pole\"]",
     {"41:17: output.front_regions: names 'pole'; must be the name of a [[region]]: 'pile' (did "
      "you "
      "mean 'pile'?)"}},
    {"UnknownField",
     "[\"velocity\"]",
     "[\"velocty\"]",
     {"40:10: output.fields: holds 'velocty'; " + fields() + " (did you mean 'velocity'?)"}},
    {"FieldTwice",
     "[\"velocity\"]",
     "[\"region\", \"region\"]",
     {"40:10: output.fields: holds 'region' twice; " + fields()}},
    {"Syntax",
     "cell_size_m = 0.1",
     "cell_size_m = = 0.1",
     {"4:15: Error while parsing value: could not determine value type; must be TOML"}},
    {"KeyTwice",
     "cell_size_m = 0.1",
     "cell_size_m = 0.1\ncell_size_m = 0.2",
     {"5:15: Error while parsing key-value pair: cannot redefine existing floating-point "
      "'cell_size_m'; must be TOML"}},
};

} // namespace

TEST_P(BadScene, SaysWhatIsWrongAndWhatIsAllowed) {
  const Case& c = GetParam();
  std::string text = good_scene;
  const std::size_t at = text.find(c.old_text);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, c.old_text.size(), c.new_text);
  EXPECT_EQ(problems_of(text), c.problems);
}

INSTANTIATE_TEST_SUITE_P(SceneErrors, BadScene, testing::ValuesIn(cases),
                         [](const auto& bad_scene) { return bad_scene.param.what; });

TEST(SceneErrors, TheGoodSceneIsGood) {
  EXPECT_EQ(problems_of(good_scene), std::vector<std::string>());
}
