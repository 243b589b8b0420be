// What containers hold, in bytes.
#pragma once

#include <cstddef>
#include <vector>

namespace scarp {

/// Bytes that the vectors have taken, used or not.
template <class... Vectors> std::size_t bytes_of(const Vectors&... vectors) {
  return (std::size_t{0} + ... + (vectors.capacity() * sizeof(typename Vectors::value_type)));
}

} // namespace scarp
