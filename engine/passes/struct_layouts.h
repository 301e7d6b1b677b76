// Layouts of the structs shared by GLSL and C++, as C++ sees them; reflection compares them with the SPIR-V.
#pragma once

#include "vulkan/shader_interface.h"

namespace drape::layouts {

extern const vulkan::StructLayout spring_push, force_push, explicit_push, bend_push, twist_push, wind_push,
    collision_push, pin_push, tension_push, grid_push, residual_push, iteration_push, residual_record;
extern const vulkan::StructLayout line_push, predict_push, particle_tethers;
extern const vulkan::StructLayout statistics_push, statistics_sum_push, statistics_record;
extern const vulkan::StructLayout collider, pinned_particle, pin_motion;
extern const vulkan::StructLayout cut_push, cutter_triangle, cut_vertex;

}  // namespace drape::layouts
