#include "bench/stability_judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/vectors.h"
#include "cloth/cloth_statistics.h"
#include "cloth/frame_inputs.h"
#include "cloth/solver_choice.h"
#include "control/impossible_pins.h"
#include "world/collider_pose.h"
#include "world/weather.h"

namespace drape::bench {

namespace {

constexpr double calm_energy = 1e-3;  ///< J/kg, that of 4 cm/s

void raise_to(Metrics& numbers, const char* name, double value) {
    double& number = numbers[name];
    // A value that is not a number is the worst there can be.
    number = value <= number ? number : std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
}

/// The largest value that `count` values in a row all reach.
double sustained(std::span<const double> values, std::size_t count) {
    double worst = 0;
    for (std::size_t first = 0; first + count <= values.size(); ++first)
        worst = std::max(worst, std::ranges::min(values.subspan(first, count)));
    return worst;
}

double largest_of_the_last(std::span<const double> values, std::size_t count) {
    if (values.empty()) return 0;
    return std::ranges::max(values.last(std::min(count, values.size())));
}

double wind_acceleration(const Wind& wind, const Cloth& cloth) {
    const double speed = length(strongest_wind(wind)) + std::abs(wind.gust.amplitude);
    if (!wind.blows()) return 0;
    return 0.5 * wind.air_density * std::max(wind.drag, wind.lift) * speed * speed / cloth.areal_density;
}

/// Largest, of springs along rows and columns that pins hold at both ends.
double held_strain(const ClothModel& cloth) {
    double largest = 0;
    const auto compare = [&](std::uint32_t a, std::uint32_t b, double rest) {
        const glsl::vec4 &p = cloth.position[a], &q = cloth.position[b];
        if (p.w == 0 && q.w == 0 && cloth.start_strain > 0)
            largest = std::max(largest, std::abs(length({p.x - q.x, p.y - q.y, p.z - q.z}) / rest - 1));
    };
    for (std::uint32_t row = 0; row < cloth.grid.rows(); ++row)
        for (std::uint32_t column = 0; column < cloth.grid.columns(); ++column) {
            const std::uint32_t here = cloth.grid.particle(column, row);
            if (column > 0) compare(here, here - 1, cloth.spacing[0]);
            if (row > 0) compare(here, here - cloth.grid.columns(), cloth.spacing[1]);
        }
    return largest;
}

}  // namespace

StabilityJudge::StabilityJudge(const SimulationModel& model) : model_(model) {
    const SceneDescription& scene = model.scene;
    passive_ = !model.windy && std::ranges::none_of(scene.colliders, [](const auto& one) { return one.path.moves(); });
    for (const ClothModel& cloth : model.cloths) {
        Start start;
        const std::vector<float> shares = mass_shares(cloth);
        start.flies = scene.colliders.empty() && !model.windy;
        for (std::size_t i = 0; i < cloth.position.size(); ++i) {
            const glsl::vec4& x = cloth.position[i];
            start.distance = std::max(start.distance, length({x.x, x.y, x.z}));
            start.mean = plus(start.mean, times(shares[i], {x.x, x.y, x.z}));
            start.mass += shares[i];
            start.flies = start.flies && (x.w != 0 || shares[i] == 0);
            start.held = start.held || (x.w == 0 && shares[i] > 0);
        }
        for (double& component : start.mean) component /= std::max(start.mass, 1e-300);
        start.mass *= cloth.inner_mass;
        start.held = start.held && !cloth.has_release && !scene.comes_apart();
        start.edge = std::min(cloth.spacing[0], cloth.spacing[1]);
        start.held_strain = held_strain(cloth);
        const Cloth& described = scene.cloths[starts_.size()];
        const double wave = cloth.rigid ? cloth.reach() * scene.time.fps
                                        : std::sqrt(described.stiffness.stretch / described.areal_density);
        start.strain_speed = cloth.start_strain * wave;
        start.wave = wave;
        start.shorter = std::min(described.size[0], described.size[1]);
        const double moving = 0.5 * dot(cloth.velocity, cloth.velocity);
        start.energy =
            start.mass * (moving - dot(gravity_at(scene, 0), start.mean) + start.strain_speed * start.strain_speed);
        start.scale = start.mass * (moving + length(strongest_gravity(scene)) * cloth.reach() +
                                    start.strain_speed * start.strain_speed + calm_energy);
        passive_ = passive_ && !cloth.has_motion;
        starts_.push_back(start);
    }
}

double StabilityJudge::bound_of_distance(std::size_t index, double time, const ClothStatistics& statistics) const {
    const ClothModel& cloth = model_.cloths[index];
    const Start& start = starts_[index];
    const double stretched = cloth.reach() * (1 + std::max(statistics.stretch.largest, 0.0));
    const double wind = length(strongest_wind(model_.scene.wind)) + std::abs(model_.scene.wind.gust.amplitude);
    // Pins and colliders that move may have strained the cloth, which flies when it is let go, at that share of the
    // speed of waves.
    const double recoil = std::min(travel_ / start.shorter, std::max(start.strained, 1.0)) * start.wave;
    // Lift turns what the cloth moves by against the wind around, and takes nothing off: twice the wind's speed.
    const double speed = length(cloth.velocity) + start.strain_speed + recoil + (model_.windy ? 2 * wind : 0) + drive_;
    const double flown = start.held ? 0 : speed * time + 0.5 * length(strongest_gravity(model_.scene)) * time * time;
    return 1.001 * (start.distance + travel_ + 2 * stretched + flown) + 1e-3;
}

void StabilityJudge::see(const FinishedFrame& frame) {
    const double time = frame.frame / model_.scene.time.fps, before = time - 1 / model_.scene.time.fps;
    const double travelled = travel_;
    ++worst_["frames"];
    raise_to(worst_, "substeps_max", frame.effort.substeps);
    if (frame.frame > 0) {
        for (const Collider& collider : model_.scene.colliders) {
            const Vec3 now = collider_pose(collider, time).center, then = collider_pose(collider, before).center;
            travel_ += length(minus(now, then));
        }
        for (const ClothModel& cloth : model_.cloths)
            for (const DynamicPin& pin : cloth.dynamic_pins) {
                const RigidTransform now = pin_transform(pin, time), then = pin_transform(pin, before);
                double turned = 0;
                for (std::size_t k = 0; k < 9; ++k) turned += std::abs(now.rotation[k] - then.rotation[k]);
                travel_ +=
                    length(minus(now.translation, then.translation)) + turned * (cloth.reach() + length(pin.pivot));
            }
        drive_ = std::max(drive_, (travel_ - travelled) * model_.scene.time.fps);
        steps_ += frame.effort.substeps;
        stretch_.push_back(0);
        penetration_.push_back(0);
        raise_to(worst_, "stretch_law", law(frame.effort.substeps, false));
        raise_to(worst_, "stretch_allowed", 3 * law(frame.effort.substeps, true));
    }
    for (std::size_t index = 0; index < model_.cloths.size(); ++index) see_cloth(index, frame, time);
}

void StabilityJudge::see_cloth(std::size_t index, const FinishedFrame& frame, double time) {
    const ClothStatistics& statistics = frame.statistics[index];
    const Start& start = starts_[index];
    starts_[index].strained = std::max(start.strained, statistics.stretch.largest - statistics.stretch_error_max);
    raise_to(worst_, "non_finite", statistics.non_finite_count);
    raise_to(worst_, "distance", statistics.largest_distance / bound_of_distance(index, time, statistics));
    if (frame.frame > 0) {
        stretch_.back() = std::max(stretch_.back(), statistics.stretch_error_max);
        if (impossible_pins(model_, frame.frame).empty())
            penetration_.back() = std::max(penetration_.back(), statistics.penetration.value_or(0) / start.edge);
    }
    raise_to(worst_, "mass", std::abs(statistics.mass / start.mass - 1));
    // Resolving an overlap works on the cloth.
    if (frame.frame == 0 && statistics.penetration.value_or(0) > 0) passive_ = false;
    if (passive_) {
        const double gained = statistics.kinetic_energy + statistics.potential_energy - start.energy;
        // Single precision adds up heights, and makes edges, that it tells only so well.
        const double strain = 2 * start.distance * std::numeric_limits<float>::epsilon() / start.edge;
        const double rounding = start.mass * (1e-6 * length(strongest_gravity(model_.scene)) * start.distance +
                                              start.wave * start.wave * strain * strain);
        raise_to(worst_, "energy", gained / (1e-4 * start.scale * std::max(steps_, 1.0) + rounding));
    }
    if (start.flies) raise_to(worst_, "flight", flight_error(index, statistics, time));
    if (!frame.positions.empty()) see_pins(model_.cloths[index], frame.positions[index], time);
}

void StabilityJudge::see_pins(const ClothModel& cloth, std::span<const float> positions, double time) {
    const auto off = [&](std::size_t particle, const Vec3& wanted, double units) {
        double largest = 0, apart = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            largest = std::max(largest, std::abs(wanted[k]));
            apart = std::max(apart, std::abs(positions[4 * particle + k] - wanted[k]));
        }
        const double allowed = units * std::numeric_limits<float>::epsilon() * largest;
        raise_to(worst_, "pins", apart == 0 ? 0 : apart / std::max(allowed, 1e-300));
    };
    std::vector<bool> dynamic(cloth.position.size());
    for (const glsl::PinnedParticle& pinned : cloth.pinned) {
        const std::size_t particle =
            cloth.grid.particle(static_cast<std::uint32_t>(pinned.index.x), static_cast<std::uint32_t>(pinned.index.y));
        dynamic[particle] = true;
        const DynamicPin& pin = cloth.dynamic_pins[static_cast<std::size_t>(pinned.index.z)];
        if (pin.release && time >= *pin.release - 1e-9) continue;
        const RigidTransform motion = pin_transform(pin, time);
        const Vec3 rest{pinned.rest.x, pinned.rest.y, pinned.rest.z};
        const Vec3 wanted = plus(rotate(motion.rotation, rest), motion.translation);
        // Rotations in single precision are about the origin: products as large as the coordinates are added up.
        off(particle, wanted,
            8 * (1 + length(rest) + length(pin.pivot) + length(motion.translation)) / std::max(length(wanted), 1e-3));
    }
    for (std::size_t i = 0; i < cloth.position.size(); ++i) {
        const glsl::vec4& at = cloth.position[i];
        if (at.w == 0 && !dynamic[i]) off(i, {at.x, at.y, at.z}, 0);
    }
}

double StabilityJudge::law(std::uint32_t substeps, bool driven) const {
    double largest = 0, held = 0, rounding = 0;
    for (std::size_t index = 0; index < model_.cloths.size(); ++index) {
        const ClothModel& cloth = model_.cloths[index];
        const double step = 1 / (model_.scene.time.fps * std::max(substeps, 1u));
        const double speed = driven ? length(cloth.velocity) + drive_ : 0;
        const double acceleration = length(strongest_gravity(model_.scene)) + speed * speed / cloth.reach() +
                                    wind_acceleration(model_.scene.wind, model_.scene.cloths[index]);
        held = std::max(held, starts_[index].held_strain);
        rounding =
            std::max(rounding, starts_[index].distance * std::numeric_limits<float>::epsilon() / starts_[index].edge);
        if (driven) held = std::max(held, cloth.start_strain / 3);
        const std::uint32_t iterations = model_.method().iterates() ? model_.scene.solver.iterations : 1;
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const double links = (axis == 0 ? cloth.grid.columns() : cloth.grid.rows()) - 1;
            largest =
                std::max(largest, acceleration * step * step * links * links / (cloth.spacing[axis] * iterations));
        }
    }
    const double law = std::min(0.02 + 0.12 * largest + 2 * rounding, 1.0 / 3);
    return std::max(held, model_.closed_loop() ? model_.stretch_limits().worst : law);
}

double StabilityJudge::flight_error(std::size_t index, const ClothStatistics& statistics, double time) const {
    const ClothModel& cloth = model_.cloths[index];
    const double c = cloth.damping, decay = c > 0 ? -std::expm1(-c * time) / c : time;
    double error = 0, way = starts_[index].distance;
    const Vec3 gravity = gravity_at(model_.scene, 0);
    for (std::size_t k = 0; k < 3; ++k) {
        const double end = c > 0 ? gravity[k] / c : 0;
        const double flown = c > 0 ? end * time + (cloth.velocity[k] - end) * decay
                                   : cloth.velocity[k] * time + 0.5 * gravity[k] * time * time;
        error = std::max(error, std::abs(statistics.center_of_mass[k] - starts_[index].mean[k] - flown));
        way = std::max(way, std::abs(flown));
    }
    const double most_substeps = worst_.contains("substeps_max") ? worst_.at("substeps_max") : 0;
    return error / ((most_substeps > 64 ? 1e-4 : 1e-5) * std::max(way, 1e-3));
}

Metrics StabilityJudge::numbers() const {
    Metrics numbers = worst_;
    numbers["stretch"] = largest_of_the_last(stretch_, stretch_.size());
    numbers["stretch_sustained"] = sustained(stretch_, sustained_frames);
    numbers["stretch_end"] = largest_of_the_last(stretch_, sustained_frames);
    numbers["penetration"] = largest_of_the_last(penetration_, penetration_.size());
    numbers["penetration_end"] = largest_of_the_last(penetration_, sustained_frames);
    return numbers;
}

bool StabilityJudge::recovered() const {
    const Metrics all = numbers();
    return breach(all, all.contains("stretch_law") ? all.at("stretch_law") : 0, 0.05).empty();
}

std::string breach(const Metrics& numbers, double stretch_limit, double penetration_limit) {
    struct Limit {
        const char* name;
        double limit;
    };
    for (const auto& [name, limit] : {Limit{"non_finite", 0},
                                      {"pins", 1},
                                      {"distance", 1},
                                      {"energy", 1},
                                      {"mass", 1e-6},
                                      {"flight", 1},
                                      {"stretch_end", stretch_limit},
                                      {"penetration_end", penetration_limit}}) {
        const auto found = numbers.find(name);
        if (found != numbers.end() && !(found->second <= limit))
            return fmt::format("{} {:.3g}, limit {:.3g}", name, found->second, limit);
    }
    return {};
}

std::string garbage(const Metrics& numbers) {
    const auto number = [&](const char* name) {
        const auto found = numbers.find(name);
        return found == numbers.end() ? 0 : found->second;
    };
    Metrics told;
    for (const char* name : {"non_finite", "pins", "distance", "stretch_end"}) told[name] = number(name);
    if (std::string text = breach(told, 3 * number("stretch_law"), 0); !text.empty()) return text;
    const double sustained = number("stretch_sustained"), allowed = number("stretch_allowed");
    if (sustained <= allowed) return {};
    return fmt::format("stretch_sustained {:.3g}, limit {:.3g}", sustained, allowed);
}

}  // namespace drape::bench
