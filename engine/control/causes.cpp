#include "control/causes.h"

#include <algorithm>
#include <cmath>

#include "base/vectors.h"
#include "cloth/bodies.h"
#include "cloth/cloth_statistics.h"
#include "cloth/frame_inputs.h"
#include "cloth/loads.h"
#include "control/balance.h"
#include "world/collider_pose.h"
#include "world/gas.h"
#include "world/weather.h"

namespace drape {

namespace {

/// A frame is divided into this number of parts to take speeds of key-framed things: splines hardly bend within one.
constexpr int parts_of_a_frame = 4;
constexpr std::size_t frames_remembered = 64;  ///< more frames than a closed loop goes back
/// Strains are computed from positions in single precision. Even where a cloth is a thousand of its cells away from the
/// origin, rounding changes a strain by less than a hundredth.
constexpr double rounding = 1.01;

/// Returns the largest distance that a point within `reach` of the centre moves by turning between two poses.
double turned(const std::array<double, 9>& before, const std::array<double, 9>& now, double reach) {
    double square = 0;
    for (std::size_t k = 0; k < 9; ++k) square += (now[k] - before[k]) * (now[k] - before[k]);
    return square > 0 ? std::sqrt(square) * reach : 0;
}

/// How far things move in some time, m: pins, any point of a collider, and the colliders' centres and forms alone.
struct Ways {
    double pins = 0, surfaces = 0, centers = 0;
};

/// Returns the largest speed, m/s, that the centre of a body can have by a time, s, as it starts, falls and is pushed.
/// What touches held cloth has fallen no farther than from its start to the end of twice the cloth's diagonal.
double fastest(const SimulationModel& model, const Causes::Start& start, const Body& body, double time) {
    const double first = length(body.collider.velocity) + body.acts.given,
                 pull = length(strongest_gravity(model.scene));
    const double fallen = first + pull * time;
    if (!start.held) return fallen;
    const double way = distance(collider_pose(body.collider, 0).center, start.mean) + 2 * start.diagonal;
    return std::min(fallen, std::sqrt(first * first + 2 * pull * way));
}

/// Adds the motion of the bodies that cloth moves, whose places only the device knows.
void add_bodies(const SimulationModel& model, const Causes::Start& start, double from, double to, Ways& most) {
    for (const Body& body : model.bodies.front().bodies) {
        const double center = fastest(model, start, body, to) * (to - from);
        const double turn = length(body.collider.angular_velocity) * shape_geometry(body.collider.shape).reach;
        most.centers = std::max(most.centers, center);
        most.surfaces = std::max(most.surfaces, center + turn * (to - from));
    }
}

Ways ways(const SimulationModel& model, const ClothModel& cloth, const Causes::Start& start, double from, double to) {
    Ways most;
    for (const DynamicPin& pin : cloth.dynamic_pins) {
        if (pin.held == no_particles) continue;  // a hand that holds nothing
        const RigidTransform before = pin_transform(pin, from), now = pin_transform(pin, to);
        const auto pivot = [&](const RigidTransform& at) {
            return plus(rotate(at.rotation, pin.pivot), at.translation);
        };
        most.pins = std::max(
            most.pins, distance(pivot(before), pivot(now)) + turned(before.rotation, now.rotation, start.diagonal));
    }
    // A seam that closes leads its particles as pins would.
    for (const Sewn& each : cloth.sewn) {
        if (each.sewn.between.z < 0) continue;
        const double closed = model.closings[static_cast<std::size_t>(each.sewn.between.z)];
        const glsl::vec4& gap = each.sewn.gap;
        most.pins =
            std::max(most.pins, length({gap.x, gap.y, gap.z}) * (opening_at(from, closed) - opening_at(to, closed)));
    }
    for (const Collider& collider : model.scene.colliders) {
        if (!collider.moves() || collider.mass) continue;
        const ColliderPose before = collider_pose(collider, from), now = collider_pose(collider, to);
        const ShapeGeometry shape = shape_geometry(collider.shape);
        const double center = distance(before.center, now.center) + deformed(collider, from, to);
        const double reach = std::min(shape.reach, start.distance + length(shape.center));
        most.centers = std::max(most.centers, center);
        most.surfaces = std::max(most.surfaces, center + turned(before.rotation, now.rotation, reach));
    }
    add_bodies(model, start, from, to, most);
    return most;
}

/// Returns the largest strain of the springs along rows and columns whose two ends are held at the start.
double strain_between_pins(const ClothModel& cloth) {
    double largest = 0;
    for (std::uint32_t row = 0; row < cloth.grid.rows(); ++row)
        for (std::uint32_t column = 0; column < cloth.grid.columns(); ++column)
            for (const std::uint32_t axis : {0u, 1u}) {
                if ((axis == 0 ? column : row) == 0) continue;
                const glsl::vec4& p = cloth.position[cloth.grid.particle(column, row)];
                const glsl::vec4& q = cloth.position[cloth.grid.particle(column - (1 - axis), row - axis)];
                if (p.w != 0 || q.w != 0) continue;
                const double now = distance({p.x, p.y, p.z}, {q.x, q.y, q.z});
                largest = std::max(largest, std::abs(now / cloth.spacing[axis] - 1));
            }
    return largest;
}

bool is_stiffened(const Cloth& cloth) {
    return std::ranges::adjacent_find(cloth.stiffness_keys, std::ranges::less(), &FactorKey::factor) !=
           cloth.stiffness_keys.end();
}

/// Gravity stretched a cloth that keys make stiffer when it was at its softest, at the factor f. The strain rho g L/(k
/// f) of a strip that hangs by its end is then released at the wave speed sqrt(k/rho) of the full stiffness: the softer
/// of warp and weft moves faster.
double recoil_of(const SceneDescription& scene, const Cloth& cloth) {
    if (!is_stiffened(cloth)) return 0;
    const double softest = std::ranges::min(cloth.stiffness_keys, {}, &FactorKey::factor).factor;
    return length(strongest_gravity(scene)) * std::max(cloth.size[0], cloth.size[1]) *
           std::sqrt(cloth.areal_density / cloth.stiffness.stretch.least()) / softest;
}

/// Returns the speed, m/s, that gas may give to the cloths which close it in: by the work that it does as it grows from
/// a volume to e^20 times that at constant temperature, or the surroundings as they press it flat.
double blown_speed(const SceneDescription& scene, const Cloth& cloth) {
    constexpr double growth = 20;
    for (const Gas& gas : scene.gas) {
        if (std::ranges::find(gas.cloths, cloth.name) == gas.cloths.end()) continue;
        double mass = 0;
        for (const Cloth& each : scene.cloths)
            if (std::ranges::find(gas.cloths, each.name) != gas.cloths.end())
                mass += each.areal_density * each.size[0] * each.size[1];
        const double pressed = std::abs(start_volume(scene, gas_walls(scene, gas)));
        return std::sqrt(2 * gas.ambient * std::max(growth * most_gas(gas), pressed) / mass);
    }
    return 0;
}

Causes::Start start_of(const SceneDescription& scene, const Cloth& described, const ClothModel& cloth,
                       const ClothStatistics& statistics) {
    Causes::Start start{.mean = statistics.center_of_mass, .diagonal = cloth.reach()};
    if (!described.loads.empty()) start.load_masses = local_load_masses(described);
    const std::vector<float> shares = mass_shares(cloth);
    double squares = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const glsl::vec4& at = cloth.position[i];
        start.distance = std::max(start.distance, length({at.x, at.y, at.z}));
        start.held = start.held || (at.w == 0 && shares[i] > 0);
        if (!cloth.velocities.empty() && at.w > 0) squares += shares[i] * dot(cloth.velocities[i], cloth.velocities[i]);
    }
    start.held = start.held && !cloth.has_release && !scene.comes_apart();
    start.square_speed =
        cloth.velocities.empty() ? dot(cloth.velocity, cloth.velocity) : squares / std::max(statistics.mass, 1e-300);
    start.strain = rounding * cloth.start_strain;
    if (start.strain > 0) start.held_strain = rounding * strain_between_pins(cloth);
    // Inextensible cloth has no wave speed: a strain spreads through all of it within a frame.
    start.wave = described.stiffness.rigid ? start.diagonal * scene.time.fps
                                           : std::sqrt(described.stiffness.stretch.largest() / described.areal_density);
    const double mass = cloth.inner_mass * (cloth.grid.columns() - 1) * (cloth.grid.rows() - 1);
    start.released = start.strain * start.wave + std::sqrt(2 * cloth.start_bending() / mass);
    start.recoil = recoil_of(scene, described);
    start.blown = blown_speed(scene, described);
    return start;
}

}  // namespace

std::vector<ClothStatistics> starting_statistics(const SimulationModel& model) {
    std::vector<ClothStatistics> all;
    for (const ClothModel& cloth : model.cloths) {
        ClothStatistics& start = all.emplace_back();
        start.stretch.largest = start.shear.largest = cloth.start_strain;
        start.largest_speed = cloth.start_speed;
        const std::vector<float> shares = mass_shares(cloth);
        for (std::size_t i = 0; i < shares.size(); ++i) {
            const glsl::vec4& at = cloth.position[i];
            start.mass += shares[i];
            start.center_of_mass = plus(start.center_of_mass, times(shares[i], Vec3{at.x, at.y, at.z}));
        }
        start.center_of_mass = times(1 / std::max(start.mass, 1e-300), start.center_of_mass);
    }
    return all;
}

Causes::Causes(const SimulationModel& model) : model_(model) {
    const auto moves = [](const auto& any) { return any.moves(); };
    const std::vector<ClothStatistics> statistics = starting_statistics(model);
    for (std::size_t k = 0; k < model.cloths.size(); ++k) {
        starts_.push_back(start_of(model.scene, model.scene.cloths[k], model.cloths[k], statistics[k]));
        starts_.back().upright = stands_upright(model, k);
    }
    led_apart_ = model.self_contact && !model.self_contact->to_part.empty();  // contact may lift such cloth
    passive_ = !model.windy && !led_apart_ && model.closings.empty() &&
               std::ranges::none_of(model.scene.colliders, moves) &&
               std::ranges::none_of(model.cloths, &ClothModel::has_motion);
    drives_.assign(1, std::vector<Drive>(starts_.size()));
    if (std::ranges::any_of(model.scene.cloths, is_stiffened)) work_ = kept_ = std::vector<double>(starts_.size());
}

/// Advances the drive of a cloth from one frame to the next.
void Causes::advance(std::size_t cloth, std::uint32_t frame, Drive& drive) const {
    const double part = 1 / (model_.scene.time.fps * parts_of_a_frame);
    const double begin = static_cast<double>(frame) * parts_of_a_frame;
    const auto ways_between = [&](double from, double to) {
        return ways(model_, model_.cloths[cloth], starts_[cloth], from * part, to * part);
    };
    for (int k = 0; k < parts_of_a_frame; ++k) {
        const Ways now = ways_between(begin + k, begin + k + 1);
        drive.speed = std::max(drive.speed, (now.pins + 2 * now.surfaces) / part);
        drive.travel += now.pins + 2 * now.surfaces;
    }
    const Ways now = ways_between(begin, begin + parts_of_a_frame);
    const double pace = std::max(now.pins, now.centers) / (parts_of_a_frame * part);
    drive.pace = std::max(drive.pace, pace);
    if (pace > 0) drive.moved = frame + 1;
}

/// A long run does not keep the drives of all its frames. For a frame that was dropped they are computed from the start
/// again.
void Causes::extend(std::uint32_t frame) {
    if (frame < first_) {
        first_ = 0;
        drives_.assign(1, std::vector<Drive>(starts_.size()));
    }
    while (first_ + drives_.size() <= frame) {
        std::vector<Drive> next = drives_.back();
        for (std::size_t cloth = 0; cloth < next.size(); ++cloth)
            advance(cloth, first_ + static_cast<std::uint32_t>(drives_.size()) - 1, next[cloth]);
        drives_.push_back(std::move(next));
        if (drives_.size() <= frames_remembered) continue;
        drives_.pop_front();
        ++first_;
    }
}

bool Causes::driven(std::uint32_t frame, double seconds) const {
    std::uint32_t moved = 0;
    for (std::size_t cloth = 0; cloth < starts_.size(); ++cloth) moved = std::max(moved, drive(frame, cloth).moved);
    return frame - std::min(moved, frame) <= seconds * model_.scene.time.fps;
}

/// Returns the speed, m/s, at which contact pushes out cloth that is nearer to something than it may be.
double Causes::pushed() const {
    const double out_of_cloth =
        (model_.self_contact ? recovery_speed * glsl::self_deep_recovery : 0) + (led_apart_ ? parting_speed : 0);
    return model_.scene.colliders.empty() ? out_of_cloth : std::max(out_of_cloth, recovery_speed);
}

/// Returns the speed, m/s, that a cloth may have by what acts on it, other cloths excepted. Held cloth falls at most
/// twice its diagonal d, so it is no faster than 2 sqrt(g d). Pins and colliders that moved may have strained it by
/// their travel divided by its smaller side, up to its full length; this strain is released at the wave speed.
double Causes::own_speed(std::uint32_t frame, std::size_t index) const {
    const Cloth& cloth = model_.scene.cloths[index];
    const Start& start = starts_[index];
    const double time = frame / model_.scene.time.fps;
    double pull = length(strongest_gravity(model_.scene));  // m/s^2
    for (std::size_t k = 0; k < start.load_masses.size(); ++k) pull += strongest(cloth.loads[k]) / start.load_masses[k];
    const double fall = start.held ? std::min(pull * time, 2 * std::sqrt(pull * start.diagonal)) : pull * time;
    const double strained = std::min(drive(frame, index).travel / std::min(cloth.size[0], cloth.size[1]), 1.0);
    return model_.cloths[index].start_speed + fall + start.blown + fastest_wind(model_.scene.wind) + start.released +
           pushed() + drive(frame, index).speed + strained * start.wave + start.recoil;
}

Causes::Reach Causes::reach(std::uint32_t frame, std::size_t index) const {
    Reach reach{own_speed(frame, index), drive(frame, index).travel};
    if (!model_.self_contact && model_.sewn_count == 0) return reach;
    double speed = 0, travel = 0;
    for (std::size_t other = 0; other < starts_.size(); ++other) {
        if (other == index) continue;
        speed = std::max(speed, own_speed(frame, other));
        travel = std::max(travel, drive(frame, other).travel);
    }
    return {reach.speed + 2 * speed, reach.travel + travel};
}

/// Leaves the elastic energy out, which started at 0 and is never negative: springs that the solver leaves stretched
/// would count at their full stiffness, though this energy was never stored.
Causes::Energy Causes::energy(std::size_t index, const ClothStatistics& now) const {
    const Start& start = starts_[index];
    const double moving = 0.5 * now.mass * start.square_speed, led = pushed();
    const double start_energy = moving - now.mass * dot(gravity_at(model_.scene, 0), start.mean);
    return {now.kinetic_energy + now.potential_energy - start_energy,
            moving + now.mass * length(strongest_gravity(model_.scene)) * start.diagonal,
            now.mass * (start.released * start.released + led * led) + (stiffens() ? work_[index] : 0), now.mass};
}

void Causes::begin(std::uint32_t frame) {
    extend(frame);
    for (std::size_t k = 0; k < work_.size(); ++k) {
        if (frame == 0) {
            work_[k] = kept_[k] = 0;
            continue;
        }
        const Cloth& cloth = model_.scene.cloths[k];
        const double before = stiffness_factor(model_.scene, cloth, frame - 1),
                     now = stiffness_factor(model_.scene, cloth, frame);
        work_[k] += std::max(now / before - 1, 0.0) * kept_[k];
    }
}

}  // namespace drape
