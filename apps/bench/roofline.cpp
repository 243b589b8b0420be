#include "apps/bench/roofline.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <experimental/simd>
#include <fstream>
#include <string_view>
#include <thread>

#include <unistd.h>

namespace scarp::bench {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The value of the first line "key : value" of a file in /proc; empty if there is none.
std::string proc_value(const char* file, std::string_view key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(':');
    if (!line.starts_with(key) || colon == std::string::npos) continue;
    const std::size_t begin = line.find_first_not_of(" \t", colon + 1);
    return begin == std::string::npos ? "" : line.substr(begin);
  }
  return "";
}

std::size_t cache_size(int name) {
  const long bytes = ::sysconf(name);
  return bytes > 0 ? static_cast<std::size_t>(bytes) : 0;
}

/// Chains of x = x * factor + increment, each in a register of its own: more than the latency of an
/// FMA (4 to 5 cycles) times the two that begin in a cycle, few enough for 16 registers.
constexpr std::size_t chains = 12;

/// noinline, and with numbers that the compiler does not know: nothing is worked out beforehand.
template <class T>
[[gnu::noinline]] T run_chains(std::int64_t rounds, T factor_value, T increment_value) {
  using Pack = std::experimental::native_simd<T>;
  const Pack factor = factor_value, increment = increment_value;
  std::array<Pack, chains> x;
  for (std::size_t k = 0; k < chains; ++k) x[k] = static_cast<T>(k);
  for (std::int64_t round = 0; round < rounds; ++round)
    for (Pack& one : x) one = one * factor + increment;
  Pack sum = T(0);
  for (const Pack& one : x) sum += one;
  return reduce(sum);
}

/// 1/s
template <class T> double peak_flops(int threads, int tries, std::int64_t rounds) {
  const double flops = 2.0 * static_cast<double>(chains) *
                       static_cast<double>(std::experimental::native_simd<T>::size()) *
                       static_cast<double>(rounds) * threads;
  double best = 0.0;
  volatile T sink = T(0);
  for (int k = 0; k < tries; ++k) {
    T sum = T(0);
    Clock::time_point start;
#pragma omp parallel num_threads(threads) reduction(+ : sum)
    {
#pragma omp barrier
#pragma omp master
      start = Clock::now();
      sum += run_chains<T>(rounds, T(0.999), T(1e-3));
    }
    best = std::max(best, flops / seconds_since(start));
    sink = sink + sum;
  }
  return best;
}

/// B/s of a = b + s c with arrays of so many numbers in all, gone through `passes` times a try.
double triad(int threads, std::size_t numbers, int tries, int passes) {
  std::vector<double> a(numbers), b(numbers), c(numbers);
  const auto n = static_cast<std::int64_t>(numbers);
  // By the threads that use them: so the pages are theirs.
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::int64_t i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    a[k] = 0.0, b[k] = 1.0, c[k] = 2.0;
  }
  double best = 0.0;
  for (int k = 0; k < tries; ++k) {
    const Clock::time_point start = Clock::now();
#pragma omp parallel num_threads(threads)
    for (int pass = 0; pass < passes; ++pass) {
      double* const to = a.data();
      const double* const from = b.data();
      const double* const scaled = c.data();
#pragma omp for simd schedule(static) nowait // every pass gives a thread the same part
      for (std::int64_t i = 0; i < n; ++i) to[i] = from[i] + 0.5 * scaled[i];
    }
    const double bytes = 3.0 * sizeof(double) * static_cast<double>(numbers) * passes;
    best = std::max(best, bytes / seconds_since(start));
  }
  return best;
}

} // namespace

std::size_t free_memory() {
  const std::string kib = proc_value("/proc/meminfo", "MemAvailable");
  return kib.empty() ? 0 : std::strtoull(kib.c_str(), nullptr, 10) * 1024U;
}

Machine this_machine() {
  Machine machine;
  machine.processor = proc_value("/proc/cpuinfo", "model name");
  if (const std::string family = proc_value("/proc/cpuinfo", "cpu family"); !family.empty())
    machine.processor +=
        fmt::format(" (family {}, model {})", family, proc_value("/proc/cpuinfo", "model\t"));
#ifdef __clang__
  machine.compiler = "clang " __clang_version__;
#else
  machine.compiler = "gcc " __VERSION__;
#endif
  machine.processors = omp_get_num_procs();
  machine.lanes = std::experimental::native_simd<double>::size();
  if (::getloadavg(&machine.load, 1) != 1) machine.load = 0.0;
  machine.free_memory = free_memory();
  machine.largest_cache =
      std::max({cache_size(_SC_LEVEL1_DCACHE_SIZE), cache_size(_SC_LEVEL2_CACHE_SIZE),
                cache_size(_SC_LEVEL3_CACHE_SIZE)});
  return machine;
}

Roofline measure_roofline(int threads, const Machine& machine, bool rough) {
  Roofline roofline;
  roofline.threads = threads;
  // Short ones: what else the machine does leaves some of them alone.
  const int tries = rough ? 10 : 100;
  constexpr std::int64_t rounds = 1'000'000;
  roofline.flops_double = peak_flops<double>(threads, tries, rounds);
  roofline.flops_single = peak_flops<float>(threads, tries, rounds);

  // Three arrays, each beyond twice the largest cache; where it is huge, what a measurement can
  // take.
  constexpr std::size_t least = std::size_t{32} << 20, most = std::size_t{256} << 20; // B
  const std::size_t bytes = std::clamp(2 * machine.largest_cache, least, rough ? least : most);
  roofline.memory_bandwidth = triad(threads, bytes / sizeof(double), std::min(tries, 20), 1);
  // Three arrays in half of every thread's second-level cache.
  constexpr std::size_t usual_cache = std::size_t{512} << 10; // B
  const std::size_t second = cache_size(_SC_LEVEL2_CACHE_SIZE);
  const std::size_t held = (second ? second : usual_cache) / 2 * static_cast<std::size_t>(threads);
  roofline.cache_bandwidth = triad(threads, held / 3 / sizeof(double), tries, 50);
  return roofline;
}

} // namespace scarp::bench
