// For tests that results do not depend on the number of threads.
#pragma once

#include <omp.h>

namespace scarp::test {

/// Sets OpenMP's number of threads as long as it lives.
class Threads {
 public:
  explicit Threads(int count) : before_(omp_get_max_threads()) { omp_set_num_threads(count); }
  ~Threads() { omp_set_num_threads(before_); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

 private:
  int before_;
};

} // namespace scarp::test
