// What the host tells the device before each frame: wind, collider poses, pin motions, per substep. Computed in
// double, rounded once. The C++ twin reads the same values. Pure.
#pragma once

#include <array>
#include <vector>

#include "cloth/simulation_model.h"

namespace drape {

enum class ColliderKind { plane, sphere, box, ellipsoid };
inline constexpr std::size_t collider_kind_count = 4;

/// Whether any collider of the kind is key-framed: then its poses are listed per substep, else once.
std::array<bool, collider_kind_count> moving_kinds(const Colliders& colliders);

/// Collider records of the kind that one frame holds: count, times substeps when the kind moves.
std::size_t collider_record_count(const SceneDescription& scene, ColliderKind kind);

struct FrameInputs {
    std::vector<glsl::vec4> wind;  ///< per substep, m/s; empty without wind
    std::array<std::vector<glsl::Collider>, collider_kind_count> colliders;
    std::vector<std::vector<glsl::PinMotion>> pins;  ///< per cloth: substep by substep, motion by motion
};

/// Inputs for simulating from frame-1 to `frame` (1 .. frame_count-1). Frame 0 is not simulated; its last substep
/// ends at time 0, so its colliders are where they start.
FrameInputs frame_inputs(const SimulationModel& model, std::uint32_t frame);

/// First record of each kind in a substep.
glsl::ivec4 first_colliders(const SceneDescription& scene, std::uint32_t substep);

}  // namespace drape
