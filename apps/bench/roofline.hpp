// What the machine can do at most, measured: arithmetic in registers and transfers from memory.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace scarp::bench {

/// With a number of threads, at the width of registers this program is compiled for.
struct Roofline {
  int threads = 1;
  double flops_double = 0.0;     ///< 1/s; a fused multiply-add counts as two
  double flops_single = 0.0;     ///< 1/s
  double memory_bandwidth = 0.0; ///< B/s, of arrays that no cache holds
  double cache_bandwidth = 0.0;  ///< B/s, of arrays that the second-level caches hold
};

struct Machine {
  std::string processor;
  std::string compiler;
  int processors = 1;              ///< that this process may use
  std::size_t lanes = 1;           ///< doubles in a register
  double load = 0.0;               ///< runnable processes, mean of a minute, before measuring
  std::size_t free_memory = 0;     ///< B
  std::size_t largest_cache = 0;   ///< B
  std::vector<Roofline> rooflines; ///< by number of threads
};

/// Without rooflines.  Quantities that the system does not tell are 0, names empty.
Machine this_machine();

/// B that a program could take now without swapping; 0 if the system does not tell.
std::size_t free_memory();

/// The best of many short tries of each, in all about two seconds; or a fraction of that, `rough`.
/// Arithmetic: independent chains of multiply-adds, which fill the pipelines.  Bandwidth: the triad
/// a = b + s c of McCalpin's STREAM, its 24 bytes a number counted, what the processor reads before
/// it writes not.
Roofline measure_roofline(int threads, const Machine& machine, bool rough);

} // namespace scarp::bench
