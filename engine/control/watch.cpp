#include "control/watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/vectors.h"
#include "cloth/cloth_statistics.h"
#include "cloth/frame_inputs.h"
#include "cloth/hang.h"
#include "cloth/self_contact.h"
#include "control/impossible_pins.h"
#include "world/collider_pose.h"
#include "world/contact_shape.h"
#include "world/overlap.h"
#include "world/weather.h"

namespace drape {

namespace {

/// It multiplies what is explained: tips of cloth whip, folds snap.
constexpr double generous = 10;
constexpr double calm_speed = 0.1;   ///< m/s that need no explanation
constexpr double settling_time = 5;  ///< s in which cloth may keep the strain that it starts with
constexpr double rounding = 1.01;    ///< factor on strains that a cloth starts with
constexpr double energy_share = 0.1;
constexpr double implausible_rms = 0.25, implausible_worst = 1;
constexpr double resting_worst = 1.0 / 3, resting_speed = 0.01;  ///< a spring's; diagonals per second
/// Springs follow fabric up to this strain: beyond it real fabric stiffens and tears.
constexpr double springs_mean = 0.5;
/// A frame is no result any more at so many times the law of stretch.
constexpr double times_law = 3;
/// Speeds of key-framed things are taken over this part of a frame.
constexpr int parts_of_a_frame = 4;

/// Returns how far a point within `reach` of the centre gets between two poses, at most.
double moved(const std::array<double, 9>& turned, const std::array<double, 9>& turn, double reach) {
    double square = 0;
    for (std::size_t k = 0; k < 9; ++k) square += (turn[k] - turned[k]) * (turn[k] - turned[k]);
    return square > 0 ? std::sqrt(square) * reach : 0;
}

double pin_moved(const DynamicPin& pin, double reach, double from, double to) {
    const auto pivot_at = [&](const RigidTransform& motion) {
        Vec3 at = rotate(motion.rotation, pin.pivot);
        for (std::size_t k = 0; k < 3; ++k) at[k] += motion.translation[k];
        return at;
    };
    const RigidTransform before = pin_transform(pin, from), now = pin_transform(pin, to);
    return distance(pivot_at(before), pivot_at(now)) + moved(before.rotation, now.rotation, reach);
}

double collider_moved(const Collider& collider, double far, double from, double to) {
    if (!collider.moves()) return 0;
    const ColliderPose before = collider_pose(collider, from), now = collider_pose(collider, to);
    return distance(before.center, now.center) + deformed(collider, from, to) +
           moved(before.rotation, now.rotation, std::min(shape_geometry(collider.shape).reach, far));
}

/// `sentence` says the value and the bound, in this order.
Implausible compare(const char* criterion, double value, double bound, const char* sentence,
                    std::optional<std::uint32_t> particle = {}) {
    // The device squares in single precision: what overflowed there is at least this.
    const double known = std::isinf(value) ? 1e19 : value;
    if (!(known / bound > 1)) return {known / bound, {}, {}, value, bound, particle};  // nobody asks for its words
    return {known / bound, fmt::format(fmt::runtime(sentence), value, bound), criterion, value, bound, particle};
}

Implausible worse(const Implausible& a, const Implausible& b) { return b.excess > a.excess ? b : a; }

/// Returns m/s at which strain comes back. Inextensible cloth has no such speed: it is through all of it in a frame.
double wave_speed(const Cloth& cloth, double diagonal, double fps) {
    return cloth.stiffness.rigid ? diagonal * fps : std::sqrt(cloth.stiffness.stretch / cloth.areal_density);
}

/// Returns the largest strain of springs along rows and columns that are held at both ends where the cloth starts.
double held_strain(const ClothModel& cloth) {
    double largest = 0;
    const auto compare_ends = [&](std::uint32_t a, std::uint32_t b, double rest) {
        const glsl::vec4 &p = cloth.position[a], &q = cloth.position[b];
        if (p.w == 0 && q.w == 0)
            largest = std::max(largest, std::abs(distance({p.x, p.y, p.z}, {q.x, q.y, q.z}) / rest - 1));
    };
    for (std::uint32_t row = 0; row < cloth.grid.rows(); ++row)
        for (std::uint32_t column = 0; column < cloth.grid.columns(); ++column) {
            const std::uint32_t here = cloth.grid.particle(column, row);
            if (column > 0) compare_ends(here, cloth.grid.particle(column - 1, row), cloth.spacing[0]);
            if (row > 0) compare_ends(here, cloth.grid.particle(column, row - 1), cloth.spacing[1]);
        }
    return largest;
}

}  // namespace

Watch::Watch(const SimulationModel& model)
    : model_(model), drives_(model.cloths.size(), {Drive{}}), stiffening_(model) {
    const auto moving = [](const Collider& collider) { return collider.moves(); };
    led_apart_ = model.self_contact && !model.self_contact->to_part.empty();  // such cloth may be lifted
    passive_ = !model.windy && !led_apart_ && std::ranges::none_of(model.scene.colliders, moving);
    for (const ClothModel& cloth : model.cloths) {
        Start start{0, {}, cloth.reach(), rounding * cloth.start_strain, 0, false, cloth.start_bending()};
        if (start.strain > 0) start.held_strain = rounding * held_strain(cloth);
        const std::vector<float> share = mass_shares(cloth);
        double mass = 0;
        for (std::size_t i = 0; i < cloth.position.size(); ++i) {
            const Vec3 at{cloth.position[i].x, cloth.position[i].y, cloth.position[i].z};
            start.distance = std::max(start.distance, length(at));
            for (std::size_t k = 0; k < 3; ++k) start.mean[k] += share[i] * at[k];
            mass += share[i];
            if (!cloth.velocities.empty() && cloth.position[i].w > 0)
                start.square_speed += share[i] * dot(cloth.velocities[i], cloth.velocities[i]);
            start.held = start.held || (cloth.position[i].w == 0 && share[i] > 0);
        }
        for (double& each : start.mean) each /= std::max(mass, 1e-300);
        start.square_speed = cloth.velocities.empty() ? dot(cloth.velocity, cloth.velocity)
                                                      : start.square_speed / std::max(mass, 1e-300);
        start.held = start.held && !cloth.has_release && !model.scene.comes_apart();
        passive_ = passive_ && !cloth.has_motion;
        starts_.push_back(start);
    }
}

/// Returns the largest speed of anything that moves in this time, m/s: pins, centres of colliders, their forms.
double Watch::pace(std::size_t cloth, double from, double to) const {
    double farthest = 0;
    for (const DynamicPin& pin : model_.cloths[cloth].dynamic_pins)
        farthest = std::max(farthest, pin_moved(pin, starts_[cloth].diagonal, from, to));
    for (const Collider& collider : model_.scene.colliders)
        if (collider.moves())
            farthest = std::max(farthest, deformed(collider, from, to) + distance(collider_pose(collider, from).center,
                                                                                  collider_pose(collider, to).center));
    return farthest / (to - from);
}

/// Returns the largest speed of anything that may push the cloth in this time, m/s.
double Watch::drive_speed(std::size_t cloth, double from, double to) const {
    const ClothModel& model = model_.cloths[cloth];
    double pins = 0, colliders = 0;
    for (const DynamicPin& pin : model.dynamic_pins)
        pins = std::max(pins, pin_moved(pin, starts_[cloth].diagonal, from, to));
    for (const Collider& collider : model_.scene.colliders) {
        const double far = starts_[cloth].distance + length(shape_geometry(collider.shape).center);
        colliders = std::max(colliders, collider_moved(collider, far, from, to));
    }
    return (pins + 2 * colliders) / (to - from);
}

Watch::Drive Watch::next_drive(std::size_t cloth, std::uint32_t frame, const Drive& before) const {
    const double part = 1 / (model_.scene.time.fps * parts_of_a_frame);
    const double begin = static_cast<double>(frame) * parts_of_a_frame;
    Drive drive = before;
    for (int k = 0; k < parts_of_a_frame; ++k) {
        const double now = drive_speed(cloth, (begin + k) * part, (begin + k + 1) * part);
        drive.speed = std::max(drive.speed, now);
        drive.travel += now * part;
    }
    const double now = pace(cloth, begin * part, (begin + parts_of_a_frame) * part);
    drive.pace = std::max(drive.pace, now);
    if (now > 0) drive.moved = frame + 1;
    return drive;
}

/// A long run does not remember all its frames: one that was forgotten is reckoned from the start again.
void Watch::extend(std::uint32_t frame) {
    if (drives_.empty()) return;
    if (frame < first_) {
        first_ = 0;
        for (std::deque<Drive>& drives : drives_) drives.assign(1, Drive{});
    }
    for (std::uint32_t last = first_ + static_cast<std::uint32_t>(drives_.front().size()) - 1; last < frame; ++last) {
        const bool full = drives_.front().size() == frames_remembered;
        for (std::size_t cloth = 0; cloth < drives_.size(); ++cloth) {
            drives_[cloth].push_back(next_drive(cloth, last, drives_[cloth].back()));
            if (full) drives_[cloth].pop_front();
        }
        if (full) ++first_;
    }
}

/// Returns m/s at which cloth moves away that lies nearer to something than it may.
double Watch::pushed() const {
    const double out_of_cloth =
        (model_.self_contact ? recovery_speed * glsl::self_deep_recovery : 0) + (led_apart_ ? parting_speed : 0);
    return model_.scene.colliders.empty() ? out_of_cloth : std::max(out_of_cloth, recovery_speed);
}

/// Returns m/s at which the strain and the bending come back that a cloth starts with.
double Watch::released(std::size_t index) const {
    const Start& start = starts_[index];
    const ClothModel& cloth = model_.cloths[index];
    const double mass = cloth.inner_mass * (cloth.grid.columns() - 1) * (cloth.grid.rows() - 1);
    return start.strain * wave_speed(model_.scene.cloths[index], start.diagonal, model_.scene.time.fps) +
           std::sqrt(2 * start.bending / mass);
}

/// Returns the speed that a cloth may have by what acts on it, m/s, without what other cloths give it.
double Watch::own_speed(std::uint32_t frame, std::size_t index) const {
    const Cloth& cloth = model_.scene.cloths[index];
    const Start& start = starts_[index];
    const double time = frame / model_.scene.time.fps, gravity = length(strongest_gravity(model_.scene));
    const double fall = start.held ? std::min(gravity * time, 2 * std::sqrt(gravity * start.diagonal)) : gravity * time;
    const double wind = length(strongest_wind(model_.scene.wind)) + std::abs(model_.scene.wind.gust.amplitude);
    const Drive& drive = drive_at(index, frame);
    const double smaller = std::min(cloth.size[0], cloth.size[1]);
    const double recoil =
        std::min(drive.travel / smaller, 1.0) * wave_speed(cloth, start.diagonal, model_.scene.time.fps);
    return model_.cloths[index].start_speed + fall + (model_.windy ? wind : 0) + released(index) + pushed() +
           drive.speed + recoil + stiffening_.recoil(index);
}

/// Returns the speed and the way that a cloth may have by all that acts on it. Struck by a much heavier one it leaves,
/// if nothing is lost, at twice that one's speed beyond its own; and it may be carried as far.
Watch::Reach Watch::reach(std::uint32_t frame, std::size_t index) const {
    Reach reach{own_speed(frame, index), drive_at(index, frame).travel};
    if (!model_.self_contact) return reach;
    double speed = 0, travel = 0;
    for (std::size_t other = 0; other < starts_.size(); ++other) {
        if (other == index) continue;
        speed = std::max(speed, own_speed(frame, other));
        travel = std::max(travel, drive_at(other, frame).travel);
    }
    return {reach.speed + 2 * speed, reach.travel + travel};
}

Implausible Watch::worst(std::uint32_t frame, std::size_t index, const ClothStatistics& statistics) const {
    const Start& start = starts_[index];
    const Reach reach = this->reach(frame, index);
    const double flown = start.held ? 0 : 2 * frame / model_.scene.time.fps * reach.speed;
    const double diagonal = start.diagonal * (1 + std::max(statistics.stretch.largest, 0.0));
    return worse(compare("speed, m/s", statistics.largest_speed, generous * reach.speed + calm_speed,
                         "moves at {:.3g} m/s, where at most {:.3g} m/s are explained", statistics.fastest),
                 compare("distance from the origin, m", statistics.largest_distance,
                         start.distance + 2 * diagonal + reach.travel + flown,
                         "is {:.3g} m from the origin, where at most {:.3g} m are explained", statistics.farthest));
}

/// Returns how deep a cloth may be in what colliders and its thickness keep free, m: as deep as one substep leads it,
/// the springs of a cell pull it, it started, and pins hold its neighbours.
Implausible Watch::worst_penetration(std::uint32_t frame, std::size_t index, const ClothStatistics& statistics) const {
    const Cloth& cloth = model_.scene.cloths[index];
    const double depth = statistics.penetration.value_or(0);
    const double cell = 2 * covering_radius(cloth) * (1 + std::max(statistics.stretch.largest, 0.0));
    double bound =
        cloth.thickness + cell + 2 * reach(frame, index).speed / (model_.scene.time.fps * model_.scene.solver.substeps);
    if (depth > bound) {  // these take long
        for (const StartOverlap& overlap : start_overlaps(model_.scene))
            if (overlap.cloth == index) bound += overlap.depth;
        if (const auto held = held_inside(model_, index, frame / model_.scene.time.fps)) bound += held->depth;
    }
    return compare("penetration, m", depth, bound,
                   "is {:.3g} m deep in what colliders keep free, where at most {:.3g} m are explained",
                   statistics.deepest);
}

/// Returns the energy that a cloth has gained, and what of it is explained, J.
Watch::Gain Watch::gain(std::size_t index, const ClothStatistics& statistics) const {
    const Start& start = starts_[index];
    const double moving = 0.5 * statistics.mass * start.square_speed;
    const double start_energy = moving - statistics.mass * dot(gravity_at(model_.scene, 0), start.mean);
    // The elastic energy, which is not negative and was 0, is left out: what a solver leaves stretched counts there at
    // the full stiffness, though it was never stored.
    const double energy = statistics.kinetic_energy + statistics.potential_energy;
    const double scale = moving + statistics.mass * (length(strongest_gravity(model_.scene)) * start.diagonal +
                                                     0.5 * calm_speed * calm_speed);
    const double given = released(index), led = pushed();
    return {energy - start_energy,
            energy_share * scale + statistics.mass * (given * given + led * led) + stiffening_.done(index)};
}

Watch::Gain Watch::gain(const std::vector<ClothStatistics>& cloths, std::size_t first, std::size_t count) const {
    Gain all{0, 0};
    for (std::size_t cloth = first; cloth < first + count; ++cloth) {
        const Gain one = gain(cloth, cloths[cloth]);
        all = {all.energy + one.energy, all.explained + one.explained};
    }
    return all;
}

/// Springs hold no more than has been lost or given: what an error put into them is no reason for more work.
void Watch::keep_elastic_energy(const std::vector<ClothStatistics>& cloths) {
    if (!passive_ || !stiffening_.happens()) return;
    for (std::size_t cloth = 0; cloth < cloths.size(); ++cloth) {
        const Gain one = model_.self_contact ? gain(cloths, 0, cloths.size()) : gain(cloths, cloth, 1);
        stiffening_.keep(cloth, std::max(std::min(one.explained - one.energy, cloths[cloth].elastic_energy), 0.0));
    }
}

/// Cloths that meet give each other energy, so that only what all have is bounded: it names the one that gained most.
Implausible Watch::worst_energy(const std::vector<ClothStatistics>& cloths, std::size_t first,
                                std::size_t count) const {
    if (!passive_) return {};
    const Gain all = gain(cloths, first, count);
    std::size_t most = first;
    double largest = -std::numeric_limits<double>::infinity();
    for (std::size_t cloth = first; cloth < first + count; ++cloth) {
        const double one = gain(cloth, cloths[cloth]).energy;
        if (one > largest) most = cloth, largest = one;
    }
    const char* sentence = count == 1
                               ? "the cloth has gained {:.3g} J, where at most {:.3g} J are explained"
                               : "it and the cloths that it meets have gained {:.3g} J, where {:.3g} J are explained";
    Implausible found = compare("energy gained, J", all.energy, all.explained, sentence);
    found.cloth = most;
    return found;
}

/// Returns the largest part of a bound; where stretch errors count too, the first cloth's that is beyond its bound.
Implausible Watch::worst_of(std::uint32_t frame, const std::vector<ClothStatistics>& cloths, bool stretch) const {
    // The work of stiffness is known of frames asked about in order, which those of a closed loop are not.
    const bool energy = stretch || !stiffening_.happens();
    Implausible most;
    for (std::size_t cloth = 0; cloth < cloths.size(); ++cloth) {
        Implausible found = worse(worst(frame, cloth, cloths[cloth]), worst_penetration(frame, cloth, cloths[cloth]));
        if (energy && !model_.self_contact) found = worse(found, worst_energy(cloths, cloth, 1));
        if (stretch) found = worse(found, worst_stretch(frame, cloth, cloths[cloth]));
        found.cloth = cloth;
        if (stretch && found.excess > 1) return found;
        most = worse(most, found);
    }
    return energy && model_.self_contact ? worse(most, worst_energy(cloths, 0, cloths.size())) : most;
}

double Watch::excess(std::uint32_t frame, const std::vector<ClothStatistics>& cloths) {
    extend(frame);
    return worst_of(frame, cloths, false).excess;
}

/// Returns what the springs of a cloth that moves at this speed (m/s) may be wrong by.
double Watch::stretch_law(std::size_t index, double speed) const {
    const ClothModel& cloth = model_.cloths[index];
    const SolverSettings& solver = model_.scene.solver;
    const Wind& wind = model_.scene.wind;
    const double step = 1 / (model_.scene.time.fps * solver.substeps);
    const double sweeps = model_.method().iterates() ? solver.iterations : 1;
    const double blows = length(strongest_wind(wind)) + std::abs(wind.gust.amplitude);
    const double blown = most_wind_acceleration(model_.scene, model_.scene.cloths[index], blows);
    const double acceleration = length(strongest_gravity(model_.scene)) + speed * speed / cloth.reach() + blown;
    double most = 0;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const double edges = (axis == 0 ? cloth.grid.columns() : cloth.grid.rows()) - 1;
        most = std::max(most, acceleration * step * step * edges * edges / (cloth.spacing[axis] * sweeps));
    }
    // Positions in single precision tell edges only so well.
    const double rounded =
        starts_[index].distance * std::numeric_limits<float>::epsilon() / std::min(cloth.spacing[0], cloth.spacing[1]);
    return 0.02 + 0.12 * most + 2 * rounded;
}

/// Returns what the springs of any cloth may err by for six frames. `driven` counts what has moved until then.
double Watch::allowed_stretch(std::uint32_t frame, bool driven) const {
    double most = model_.asked_tolerance;
    if (model_.closed_loop() || model_.self_contact) most = std::max(most, times_law * model_.stretch_limits().worst);
    for (std::size_t cloth = 0; cloth < starts_.size(); ++cloth) {
        const Start& start = starts_[cloth];
        const double speed = driven ? model_.cloths[cloth].start_speed + drive_at(cloth, frame).pace : 0;
        const double law = model_.closed_loop() ? 0 : std::min(times_law * stretch_law(cloth, speed), 1.0);
        most = std::max({most, law, start.held_strain, driven ? start.strain : 0});
    }
    return most;
}

/// Returns whether something moves the cloths, or did within the time in which they settle.
bool Watch::driven(std::uint32_t frame) const {
    std::uint32_t moved = 0;
    for (std::size_t cloth = 0; cloth < starts_.size(); ++cloth) moved = std::max(moved, drive_at(cloth, frame).moved);
    return frame - std::min(moved, frame) <= settling_time * model_.scene.time.fps;
}

std::optional<Implausible> Watch::lasting_stretch(std::uint32_t frame, const std::vector<ClothStatistics>& cloths) {
    if (frame == 0 || cloths.empty()) return std::nullopt;
    const auto worst = std::ranges::max_element(cloths, {}, &ClothStatistics::stretch_error_max);
    recent_.push_back(worst->stretch_error_max);
    if (recent_.size() > frames_in_a_row) recent_.pop_front();
    last_ = {frame, static_cast<std::uint32_t>(worst - cloths.begin())};
    if (recent_.size() < frames_in_a_row) return std::nullopt;
    Implausible found = compare(
        "stretch error of a spring for six frames", std::ranges::min(recent_), allowed_stretch(frame, driven(frame)),
        "begins the worst of springs whose stretch error is {:.3g} or more of their length for six "
        "frames (bound {:.3g})",
        worst->most_stretched);
    found.cloth = last_.cloth;
    return found.excess > 1 ? std::optional(found) : std::nullopt;
}

/// Returns ", the particle in column 3, row 4"; nothing where there is none.
static std::string place_text(const Grid& grid, std::optional<std::uint32_t> particle) {
    if (!particle) return {};
    return fmt::format(", the particle in column {}, row {}", *particle % grid.columns(), *particle / grid.columns());
}

std::vector<std::string> Watch::warnings() const {
    std::vector<std::string> all;
    if (deep_.value > 0)
        all.push_back(fmt::format(
            "from frame {} on cloth '{}' is deeper than {:.3g} m in what colliders and its thickness keep free, up to "
            "{:.3g} m in frame {}{}: more room between colliders, slower ones or more substeps may help",
            deep_.first, model_.cloths[deep_.cloth].name, usual_penetration(deep_.cloth), deep_.value, deep_.worst,
            place_text(model_.cloths[deep_.cloth].grid, deep_.particle)));
    if (torn_.value > 0)
        all.push_back(fmt::format(
            "from frame {} on springs of cloth '{}' are stretched by more than {:.0f} %, up to {:.3g} % in frame {}, "
            "as "
            "forces and pins pull them: fabric would have torn; stiffer springs, weaker forces or pins less far apart "
            "may help",
            torn_.first, model_.cloths[torn_.cloth].name, 100 * springs_mean, 100 * torn_.value, torn_.worst));
    if (recent_.empty()) return all;
    const double largest = std::ranges::max(recent_), allowed = allowed_stretch(last_.frame, false);
    if (largest > allowed)
        all.push_back(
            fmt::format("cloth '{}' has not settled when the run ends, in frame {}: in the last frames the stretch "
                        "error of a spring "
                        "comes to {:.3g} of its length, where cloth that nothing moves keeps {:.3g}; a longer scene "
                        "shows whether it "
                        "settles",
                        model_.cloths[last_.cloth].name, last_.frame, largest, allowed));
    return all;
}

Implausible Watch::worst_stretch(std::uint32_t frame, std::size_t index, const ClothStatistics& statistics) const {
    const Start& start = starts_[index];
    const bool settles = frame <= settling_time * model_.scene.time.fps;
    const double asked = std::max(model_.asked_tolerance, settles ? start.strain : start.held_strain);
    // Particles may be so far apart that a spring's length overflows and its error is a NaN.
    const auto known = [](double error) { return std::isnan(error) ? std::numeric_limits<double>::infinity() : error; };
    Implausible result = worse(
        compare("stretch error, RMS", known(statistics.stretch_error_rms), std::max(implausible_rms, asked),
                "begins the worst spring of a stretch error of {:.3g} RMS (bound {:.3g})", statistics.most_stretched),
        compare("stretch error of a spring", known(statistics.stretch_error_max), std::max(implausible_worst, asked),
                "begins a spring whose stretch error is {:.3g} of its length (bound {:.3g})",
                statistics.most_stretched));
    if (frame == 0 || result.excess > 1) return result;
    if (statistics.largest_speed > resting_speed * start.diagonal) return result;
    return compare("stretch error of a spring at rest", statistics.stretch_error_max, std::max(resting_worst, asked),
                   "begins a spring whose stretch error is {:.3g} of its length (bound {:.3g}), though the cloth rests",
                   statistics.most_stretched);
}

void Watch::Note::keep(std::uint32_t frame, std::size_t index, double now, std::optional<std::uint32_t> at) {
    if (!(now > 0) || !std::isfinite(now)) return;
    if (value == 0) first = frame;
    if (now <= value) return;
    value = now, worst = frame, cloth = static_cast<std::uint32_t>(index), particle = at;
}

/// A tenth of a cell or the thickness is what contact may leave of a cloth in what it keeps free.
double Watch::usual_penetration(std::size_t index) const {
    const ClothModel& cloth = model_.cloths[index];
    return 0.1 * std::max({cloth.spacing[0], cloth.spacing[1], model_.scene.cloths[index].thickness});
}

void Watch::note_penetration(std::uint32_t frame, std::size_t index, const ClothStatistics& statistics) {
    const double depth = statistics.penetration.value_or(0);
    starts_depth_.resize(starts_.size());
    if (frame == 0) starts_depth_[index] = depth;
    const double usual = usual_penetration(index) + starts_depth_[index];
    if (frame == 0 || depth <= usual) return;
    const auto held = held_inside(model_, index, frame / model_.scene.time.fps);
    if (depth > usual + (held ? held->depth : 0)) deep_.keep(frame, index, depth, statistics.deepest);
}

/// Stretch that the solver leaves is an error, and judged as one; what a cloth starts stretched by is the scene's
/// own.
void Watch::note_stretch(std::uint32_t frame, std::size_t index, const ClothStatistics& statistics) {
    if (statistics.stretch.spring_count == 0) return;
    const double strain = statistics.stretch.largest - statistics.stretch_error_max;
    if (strain > std::max(springs_mean, starts_[index].strain)) torn_.keep(frame, index, strain, {});
}

void Watch::remember(const ClothStatistics& statistics) {
    if (statistics.stretch.spring_count == 0) return;
    const auto keep = [](std::optional<double>& worst, double value) {
        if (std::isfinite(value)) worst = std::max(worst.value_or(value), value);
    };
    keep(worst_rms_, statistics.stretch_error_rms);
    keep(worst_max_, statistics.stretch_error_max);
}

std::optional<Implausible> Watch::implausible(std::uint32_t frame, const std::vector<ClothStatistics>& cloths) {
    extend(frame);
    stiffening_.begin(frame);
    for (std::size_t cloth = 0; cloth < cloths.size(); ++cloth) {
        remember(cloths[cloth]);
        note_penetration(frame, cloth, cloths[cloth]);
        note_stretch(frame, cloth, cloths[cloth]);
    }
    const Implausible found = worst_of(frame, cloths, true);
    keep_elastic_energy(cloths);
    std::optional<Implausible> failed = found.excess > 1 ? std::optional(found) : lasting_stretch(frame, cloths);
    if (failed) recent_.clear();  // whether it settles is no question any more
    return failed;
}

}  // namespace drape
