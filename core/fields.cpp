#include "core/fields.hpp"

#include "core/error.hpp"

namespace scarp {

const std::vector<FieldInfo>& field_table() {
  static const std::vector<FieldInfo> table = {
      {"displacement", 3, "m", "since time 0"},
      {"velocity", 3, "m/s", ""},
      {"velocity_gradient", 9, "1/s",
       "around the point, xx xy xz yx yy yz zx zy zz with the component of the velocity first; 0 "
       "unless method.transfer is affine"},
      {"stress", 6, "Pa", "Cauchy stress, tension positive"},
      {"mean_stress", 1, "Pa", "tr(sigma)/3, tension positive"},
      {"deviatoric_stress", 1, "Pa", "sqrt(J2)"},
      {"equivalent_plastic_strain", 1, "-", "sum of sqrt(2/3 de_p:de_p), deviatoric"},
      {"density", 1, "kg/m3", ""},
      {"volume", 1, "m3", "per metre of depth in plane strain"},
      {"initial_volume", 1, "m3", "per metre of depth in plane strain"},
      {"gap", 1, "-", "volumetric strain by which the point stands open in tension"},
      {"region", 1, "-", "index of the region in the scene, from 0"},
  };
  return table;
}

const FieldInfo& field_info(const std::string& name) {
  std::string names;
  for (const FieldInfo& info : field_table()) {
    if (info.name == name) return info;
    names += (names.empty() ? "" : ", ") + info.name;
  }
  throw SetupError("no field '" + name + "'; there are " + names);
}

} // namespace scarp
