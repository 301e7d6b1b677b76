// The host tells the device this before each frame: wind, collider poses, pin motions, per substep. It is computed in
// double and rounded once. The C++ twin reads the same values.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "cloth/simulation_model.h"
#include "shared/collider_types.h"
#include "world/motion.h"

namespace drape {

/// Returns the motion of a pin at a time: x = R (rest - pivot) + pivot + translation, about its pivot.
RigidTransform pin_transform(const DynamicPin& pin, double time);

/// Returns how many collider records a frame has room for: those of every list (SimulationModel::kept_colliders) once,
/// or per substep when any is key-framed.
std::size_t collider_record_count(const SimulationModel& model);
/// Returns the first record of a cloth in a substep.
int first_collider(const SimulationModel& model, const ClothModel& cloth, std::uint32_t substep);
/// Returns how many colliders are of each kind or one before it: where the kind ends in the sorted list.
std::array<std::uint32_t, glsl::collider_kind_count> kind_ends(const std::vector<Collider>& colliders);

/// Returns what the device knows of a collider at the time `now`, and of its motion since `before`, s. `field`: a
/// mesh's first texel (MeshFields). What it deforms by is not said.
glsl::ColliderRecord collider_record(const Collider& collider, double before, double now, const Vec3& way_out = {},
                                     std::size_t field = 0);

/// Says in a record which share of the frame is over when the substep ends, and that its surface moves so much farther
/// in the substep, m, as it deforms.
void add_deformation(glsl::ColliderRecord& record, double share, double way);

struct FrameInputs {
    /// Per member and substep the wind, m/s, and where gravity changes, behind it, what gravity is more than at the
    /// start, m/s^2; empty without either.
    std::vector<glsl::vec4> wind;
    std::vector<float> stiffness;                 ///< per cloth the factor of its stiffness; empty where none changes
    std::vector<glsl::ColliderRecord> colliders;  ///< per substep, list by list, in the scene's order
    std::uint32_t collider_sets = 1;              ///< number of substeps that these are of; 1: of all
    std::shared_ptr<const FormLists> forms;       ///< of meshes that deform; null: there are none
    std::vector<std::vector<glsl::PinMotion>> pins;  ///< per cloth: substep by substep, motion by motion
};

/// Returns inputs for simulating from frame-1 to `frame` (1 .. frame_count-1). Frame 0 is not simulated; its last
/// substep ends at time 0, so its colliders are where they start.
FrameInputs frame_inputs(const SimulationModel& model, std::uint32_t frame);
/// Puts them in the place of others.
void take_frame_inputs(const SimulationModel& model, std::uint32_t frame, FrameInputs& inputs);

}  // namespace drape
