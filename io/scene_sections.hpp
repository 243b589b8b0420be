// The sections of a scene file, each with its options; io/scene_schema.hpp has them together.
#pragma once

#include "core/scene.hpp"
#include "io/scene_option.hpp"

namespace scarp::io {

Section<Grid> grid_section();
Section<Grid> walls_section();
Section<Gate> gate_section();
Section<Timing> time_section();
Section<Method> method_section();
Section<Material> material_section();
Section<Region> region_section();
Section<Stage> stage_section();
Section<Monitor> monitor_section();
Section<Output> output_section();

} // namespace scarp::io
