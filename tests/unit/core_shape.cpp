#include "core/linear_shape.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

#include <type_traits>

using namespace scarp;
using scarp::test::Random;

namespace {

template <class Dimension> class Shape : public testing::Test {
 protected:
  static constexpr int dim = Dimension::value;
  static constexpr double h = 0.25; ///< m, cell size
  static constexpr int samples = 200;
  Random random{20080101};

  Vec<dim> point_in_cell() {
    Vec<dim> xi;
    for (Real& along : xi) along = random.between(0.0, 1.0);
    return xi;
  }

  /// m, place of corner c in the cell: bit a of c is its side along axis a.
  static Vec<dim> corner(std::size_t c) {
    Vec<dim> x;
    for (std::size_t a = 0; a < dim; ++a) x[a] = (c >> a & 1) ? h : 0.0;
    return x;
  }
};

using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
struct DimensionName {
  template <class Dimension> static std::string GetName(int) {
    return std::to_string(Dimension::value) + "d";
  }
};
TYPED_TEST_SUITE(Shape, Dimensions, DimensionName);

} // namespace

TYPED_TEST(Shape, IsAPositivePartitionOfUnity) {
  constexpr int Dim = TypeParam::value;
  for (int sample = 0; sample < this->samples; ++sample) {
    const LinearShape<Dim> shape(this->point_in_cell(), 1.0 / this->h);
    Real total = 0.0;
    Vec<Dim> slope = {};
    for (std::size_t c = 0; c < shape.nodes; ++c) {
      EXPECT_GE(shape.N[c], 0.0);
      EXPECT_LE(shape.N[c], 1.0);
      total += shape.N[c];
      for (std::size_t a = 0; a < Dim; ++a) slope[a] += shape.dN[c][a];
    }
    EXPECT_NEAR(total, 1.0, 1e-15);
    for (const Real along : slope) EXPECT_NEAR(along, 0.0, 1e-14); // of terms up to 1/h = 4
  }
}

TYPED_TEST(Shape, IsOneAtItsOwnCornerAndZeroAtTheOthers) {
  constexpr int Dim = TypeParam::value;
  for (std::size_t at = 0; at < LinearShape<Dim>::nodes; ++at) {
    Vec<Dim> xi = this->corner(at);
    for (Real& along : xi) along /= this->h;
    const LinearShape<Dim> shape(xi, 1.0 / this->h);
    for (std::size_t c = 0; c < shape.nodes; ++c) EXPECT_EQ(shape.N[c], c == at ? 1.0 : 0.0);
  }
}

/// u = a + b . x at the corners gives u at the point, and b as its gradient.
TYPED_TEST(Shape, ReproducesLinearFields) {
  constexpr int Dim = TypeParam::value;
  for (int sample = 0; sample < this->samples; ++sample) {
    const Real a = this->random.between(-1.0, 1.0);
    Vec<Dim> b;
    for (Real& slope : b) slope = this->random.between(-1.0, 1.0);
    const auto field = [&](const Vec<Dim>& x) {
      Real value = a;
      for (std::size_t i = 0; i < Dim; ++i) value += b[i] * x[i];
      return value;
    };
    const Vec<Dim> xi = this->point_in_cell();
    Vec<Dim> x = xi;
    for (Real& along : x) along *= this->h;

    const LinearShape<Dim> shape(xi, 1.0 / this->h);
    Real value = 0.0;
    Vec<Dim> gradient = {};
    for (std::size_t c = 0; c < shape.nodes; ++c) {
      const Real at_corner = field(this->corner(c));
      value += shape.N[c] * at_corner;
      for (std::size_t i = 0; i < Dim; ++i) gradient[i] += shape.dN[c][i] * at_corner;
    }
    EXPECT_NEAR(value, field(x), 1e-15);
    for (std::size_t i = 0; i < Dim; ++i) EXPECT_NEAR(gradient[i], b[i], 1e-13);
  }
}

/// N is linear along each axis, so a central difference of any
/// width inside the cell is its exact slope.
TYPED_TEST(Shape, GradientIsTheSlopeOfN) {
  constexpr int Dim = TypeParam::value;
  for (int sample = 0; sample < this->samples; ++sample) {
    const Vec<Dim> xi = this->point_in_cell();
    const LinearShape<Dim> shape(xi, 1.0 / this->h);
    for (std::size_t a = 0; a < Dim; ++a) {
      Vec<Dim> low = xi;
      Vec<Dim> high = xi;
      low[a] = 0.0;
      high[a] = 1.0;
      const LinearShape<Dim> at_low(low, 1.0 / this->h);
      const LinearShape<Dim> at_high(high, 1.0 / this->h);
      for (std::size_t c = 0; c < shape.nodes; ++c)
        EXPECT_NEAR(shape.dN[c][a], (at_high.N[c] - at_low.N[c]) / this->h, 1e-14);
    }
  }
}
