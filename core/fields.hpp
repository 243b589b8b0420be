// The one table of what a run can write: series, restarts and colours all use these names.
#pragma once

#include <string>
#include <vector>

namespace scarp {

struct FieldInfo {
  std::string name;
  int components; ///< 1 scalar, 3 vector x y z, 6 symmetric tensor xx yy zz xy yz xz
  std::string unit;
  std::string description;
};

const std::vector<FieldInfo>& field_table();

/// Throws SetupError that names the fields there are.
const FieldInfo& field_info(const std::string& name);

} // namespace scarp
