// Steps of a small collapse and nothing else, for tests/benchmarks/instructions.sh:
//   scarp_steps DIMENSION linear|bspline flip|apic STEPS
// prints its number of points.
#include "apps/bench/collapse.hpp"

#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

int main(int argc, char** argv) {
  using namespace scarp;
  if (argc != 5) {
    std::fprintf(stderr, "usage: scarp_steps DIMENSION linear|bspline flip|apic STEPS\n");
    return 2;
  }
  constexpr double about = 3000.0; // points
  const bench::CollapseSize size = bench::collapse_of(std::atoi(argv[1]), about);
  Method method;
  method.shape =
      std::string(argv[2]) == "bspline" ? ShapeFunctions::bspline : ShapeFunctions::linear;
  method.transfer =
      std::string(argv[3]) == "apic" ? VelocityTransfer::apic : VelocityTransfer::flip;
  method.flip = 0.999;
  const auto simulation = bench::begin_collapse(size, method, bench::collapse_start(size));
  for (long step = std::atol(argv[4]); step > 0; --step)
    simulation->step(std::numeric_limits<double>::infinity());
  std::printf("%zu\n", simulation->points());
  return 0;
}
