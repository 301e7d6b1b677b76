#include "control/drive.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/vectors.h"
#include "cloth/frame_inputs.h"
#include "cloth/hang.h"
#include "control/frame_judgement.h"
#include "mesh/mesh_sequence.h"
#include "world/collider_pose.h"

namespace drape {

namespace {

/// Drives are computed at this number of instants in a frame.
constexpr int parts = 4;
/// An event drives a cloth at least this many times as hard as the last probe's frames did: fewer substeps are taken
/// where errors are below 0.6 of their limits.
constexpr double considerable = 1.7;

/// Returns the acceleration, m/s^2, of points at distance `reach` along the axes from a centre that moves by `at`(time)
/// -> (rotation, centre).
template <class Motion>
double acceleration(const Motion& at, double reach, double time, double step) {
    const auto before = at(time - step), now = at(time), after = at(time + step);
    double most = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Vec3 change;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto place = [&](const auto& pose) { return pose.center[k] + reach * pose.rotation[3 * k + axis]; };
            change[k] = place(before) - 2 * place(now) + place(after);
        }
        most = std::max(most, length(change));
    }
    return most / (step * step);
}

double of_pins(const ClothModel& cloth, double time, double step) {
    double most = 0;
    for (const DynamicPin& pin : cloth.dynamic_pins) {
        if (!pin.path.moves() || (pin.release && *pin.release < time)) continue;
        const auto at = [&](double t) {
            const RigidTransform motion = motion_at(pin.path, t);
            return ColliderPose{motion.rotation, motion.translation};
        };
        most = std::max(most, acceleration(at, cloth.reach(), time, step));
    }
    return most;
}

/// Vertices move in straight lines between poses, so their acceleration is taken over the time from one pose to the
/// next.
double of_form(const Mesh& mesh, double time, double step) {
    const double apart = std::max(step, 1 / mesh.frames_per_second);
    const auto at = [&](double t) { return pose_number(mesh, t); };
    return 2 * mesh.sequence->farthest_off_middle(at(time - apart), at(time), at(time + apart)) / (apart * apart);
}

double of_colliders(const SceneDescription& scene, const ClothModel& cloth, double time, double step) {
    double most = 0;
    for (const Collider& collider : scene.colliders) {
        if (collider.deforms()) most = std::max(most, of_form(std::get<Mesh>(collider.shape), time, step));
        if (!collider.path.moves()) continue;
        const double reach = std::min<double>(shape_geometry(collider.shape).reach, cloth.reach());
        most = std::max(most, acceleration([&](double t) { return collider_pose(collider, t); }, reach, time, step));
    }
    return most;
}

}  // namespace

std::vector<double> drive_of(const SimulationModel& model, std::uint32_t frame) {
    const SceneDescription& scene = model.scene;
    const double step = 0.5 / (scene.time.fps * parts);  // keeps the differences within the frame
    std::vector<double> drive(model.cloths.size(), 0);
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
        for (int part = 0; part < parts; ++part) {
            const double time = (static_cast<double>(frame) - 1) / scene.time.fps + (2 * part + 1) * step;
            drive[cloth] = std::max(drive[cloth], weather_acceleration(scene, scene.cloths[cloth], time) +
                                                      of_pins(model.cloths[cloth], time, step) +
                                                      of_colliders(scene, model.cloths[cloth], time, step));
        }
    return drive;
}

bool Drive::eventful(std::uint32_t frame) const {
    if (releases(model_, frame)) return true;
    if (probed_.empty()) return false;
    const std::vector<double> now = drive_of(model_, frame);
    for (std::size_t cloth = 0; cloth < now.size(); ++cloth)
        if (now[cloth] > considerable * probed_[cloth]) return true;
    return false;
}

void Drive::probed(std::uint32_t frame, std::uint32_t count) {
    probed_.assign(model_.cloths.size(), 0);
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::vector<double> drive = drive_of(model_, frame + k);
        for (std::size_t cloth = 0; cloth < drive.size(); ++cloth)
            probed_[cloth] = std::max(probed_[cloth], drive[cloth]);
    }
}

}  // namespace drape
