#include "cloth/forces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include "base/vectors.h"
#include "cloth/cloth_statistics.h"
#include "cloth/directions.h"
#include "cloth/sewing.h"
#include "cloth/texels.h"
#include "world/weather.h"

namespace drape {

namespace {

bool is_held(const ClothModel& cloth) {
    for (std::size_t i = 0; i < cloth.position.size(); ++i)
        if (cloth.position[i].w == 0 && cloth.free_weight[i] > 0) return true;
    return false;
}

std::size_t index_of(const SimulationModel& model, const ClothModel& cloth) {
    return static_cast<std::size_t>(&cloth - model.cloths.data());
}

bool meets_others(const SimulationModel& model) { return model.self_contact && model.scene.cloths.size() > 1; }

std::size_t most_pins(const SceneDescription& scene) {
    std::size_t most = 0;
    for (const Cloth& cloth : scene.cloths) most = std::max(most, cloth.pins.size());
    return most;
}

/// Impulse, N s, and its moment, N m s.
struct Impulse {
    Vec3 given{}, moment{};
};

/// Reads the sums of a frame.
class Impulses {
  public:
    Impulses(std::span<const std::byte> bytes, const ClothModel& cloth)
        : bytes_(bytes),
          unit_(cloth.inner_mass / cloth.substep_length / units()),
          damped_(damping_mean(cloth.damping, cloth.substep_length)) {}

    Vec3 vector(std::size_t row, std::size_t first, double unit) const {
        return times(unit, {number(row, first), number(row, first + 1), number(row, first + 2)});
    }
    Impulse at(std::size_t row) const { return {vector(row, 0, unit_), vector(row, 3, unit_)}; }
    /// Returns what was given to motions, of whose forces damping leaves a share in a substep: of gravity too, which
    /// contact at rest opposes.
    Impulse contact(std::size_t row) const {
        return {vector(row, 0, unit_ / damped_), vector(row, 3, unit_ / damped_)};
    }
    /// Returns by how much the momentum changed in the frame, kg m/s.
    Vec3 change() const { return vector(glsl::impulse_momentum, 0, unit_); }
    /// Returns the motion of the free particles times their masses, in those of an inner particle, m.
    Vec3 travel() const { return vector(glsl::impulse_momentum, 3, 1.0 / double{glsl::travel_units}); }

  private:
    glsl::uint word(std::size_t row, std::size_t column) const {
        glsl::uint value = 0;
        std::memcpy(&value, &bytes_[(row * glsl::impulse_columns + column) * sizeof value], sizeof value);
        return value;
    }
    double units() const { return double{glsl::uintBitsToFloat(word(glsl::impulse_head, 0))}; }
    double number(std::size_t row, std::size_t place) const {
        const std::uint64_t low = word(row, 2 * place), high = word(row, 2 * place + 1);
        return static_cast<double>(static_cast<std::int64_t>(high << 32 | low));
    }

    std::span<const std::byte> bytes_;
    double unit_;    ///< kg m/s of a unit
    double damped_;  ///< the share that damping leaves
};

/// Returns gravity's impulse on a kilogram in a frame, m/s, as substeps take it: at their middles.
Vec3 fall(const SimulationModel& model, std::uint32_t frame) {
    const double length = 1 / model.scene.time.fps, substep = length / model.scene.solver.substeps;
    Vec3 sum{};
    for (std::uint32_t k = 0; k < model.scene.solver.substeps; ++k)
        sum = plus(sum, times(substep, gravity_at(model.scene, (frame - 1) * length + (k + 0.5) * substep)));
    return sum;
}

/// Returns what a load's force gave in a frame, N s, as substeps take it.
Vec3 pulled(const SimulationModel& model, const Load& load, std::uint32_t frame) {
    const double length = 1 / model.scene.time.fps, substep = length / model.scene.solver.substeps;
    Vec3 sum{};
    for (std::uint32_t k = 0; k < model.scene.solver.substeps; ++k)
        sum = plus(sum, times(substep, force_at(load, (frame - 1) * length + (k + 0.5) * substep)));
    return sum;
}

/// Returns what a source gave to a cloth of this mass, kg. `fallen`: what gravity gave to a kilogram, m/s.
Impulse given_by(const ForceSource& source, const SimulationModel& model, const ClothModel& cloth, const Impulses& sums,
                 double mass, const Vec3& fallen) {
    switch (source.cause) {
        case ForceCause::gravity:
            return {times(mass, fallen), {}};
        case ForceCause::damping:
            return {times(-cloth.damping * cloth.inner_mass, sums.travel()), {}};
        case ForceCause::air:
            return sums.at(glsl::impulse_air);
        case ForceCause::loads:
            return sums.at(glsl::impulse_loads);
        case ForceCause::other_cloths:
            return sums.contact(glsl::impulse_cloths);
        case ForceCause::colliders:
            return sums.contact(glsl::impulse_first + source.number);
        case ForceCause::pins:
            return sums.at(first_pin_row(model.scene) + source.number);
        case ForceCause::hands:
        case ForceCause::seams:
            return {};
    }
    return {};
}

/// Returns the largest impulse, and the largest moment, that a source gave in a substep; nothing where only a frame's
/// is known. `first_worst`: the first row of what the sums keep of that.
std::optional<Impulse> worst_of(const ForceSource& source, const Impulses& sums, std::size_t first_worst) {
    switch (source.cause) {
        case ForceCause::air:
            return sums.at(first_worst + glsl::impulse_air);
        case ForceCause::loads:
            return sums.at(first_worst + glsl::impulse_loads);
        case ForceCause::other_cloths:
            return sums.contact(first_worst + glsl::impulse_cloths);
        case ForceCause::colliders:
            return sums.contact(first_worst + glsl::impulse_first + source.number);
        // Gravity is known anyway. Pins, hands and seams bear the rest of a frame, and damping is found with that.
        case ForceCause::gravity:
        case ForceCause::pins:
        case ForceCause::hands:
        case ForceCause::seams:
        case ForceCause::damping:
            return std::nullopt;
    }
    return std::nullopt;
}

/// Returns for what share of a frame a pin or hand holds its particles.
double held_share(const SceneDescription& scene, const DynamicPin& pin, std::uint32_t frame) {
    if (pin.held == no_particles) return 0;
    return pin.release ? std::clamp(*pin.release * scene.time.fps - (frame - 1), 0.0, 1.0) : 1.0;
}

/// Calls `take` with each particle of a cloth that is held in a frame, for what share of it, and by which of its pins;
/// all hands together come after these.
template <class Take>
void for_each_held(const SimulationModel& model, std::size_t index, std::uint32_t frame, const Take& take) {
    const ClothModel& cloth = model.cloths[index];
    const std::size_t pins = model.scene.cloths[index].pins.size();
    std::vector<double> shares(pins, 1);
    for (const DynamicPin& pin : cloth.dynamic_pins) {
        const double share = held_share(model.scene, pin, frame);
        if (!pin.hand) shares[pin.number] = share;
        for (std::uint32_t row = pin.held.first[1]; pin.hand && share > 0 && row <= pin.held.last[1]; ++row)
            for (std::uint32_t column = pin.held.first[0]; column <= pin.held.last[0]; ++column)
                take(cloth.grid.particle(column, row), share, pins);
    }
    const std::vector<glsl::uint> numbers = pin_numbers(model, index);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (numbers[i] > 0) take(i, shares[numbers[i] - 1], numbers[i] - 1);
}

/// Returns the mass, kg, that each pin of a cloth holds, on average over a frame, and then that of its hands.
std::vector<double> held_masses(const SimulationModel& model, std::size_t index, std::uint32_t frame) {
    const ClothModel& cloth = model.cloths[index];
    std::vector<double> masses(model.scene.cloths[index].pins.size() + 1);
    const std::vector<float> shares = mass_shares(cloth);
    for_each_held(model, index, frame, [&](std::size_t particle, double share, std::size_t by) {
        masses[by] += share * cloth.inner_mass * double{shares[particle]};
    });
    return masses;
}

/// Returns what the forces of loads gave to what each of them holds, N s.
std::vector<Vec3> held_pulls(const SimulationModel& model, std::size_t index, std::uint32_t frame) {
    const ClothModel& cloth = model.cloths[index];
    std::vector<Vec3> pulls(model.scene.cloths[index].pins.size() + 1), each;
    if (cloth.load_depth == 0) return pulls;
    for (const Load& load : model.scene.cloths[index].loads) each.push_back(pulled(model, load, frame));
    for_each_held(model, index, frame, [&](std::size_t particle, double held, std::size_t by) {
        for (std::size_t k = 0; k < cloth.load_depth; ++k) {
            const glsl::vec4& share = cloth.loads[cloth.load_depth * particle + k];
            if (share.x < 0) break;
            pulls[by] = plus(pulls[by], times(held * double{share.y}, each[static_cast<std::size_t>(share.x)]));
        }
    });
    return pulls;
}

/// Where seams stand among those that bear the rest of a frame: behind pins, before all others, or behind all.
enum class SeamRest : std::uint8_t { behind_pins, first, last };

/// The impulses of a frame on a cloth, by source.
struct Account {
    const std::vector<ForceSource>& sources;
    std::vector<Impulse> impulses{};
    Vec3 left{};                 ///< what they leave of the change of momentum
    std::vector<double> held{};  ///< kg, by pin, and by hands
    SeamRest seams{};            ///< where seams stand among those that bear the rest

    void add(const Impulse& impulse) {
        impulses.push_back({{}, impulse.moment});
        give(impulses.size() - 1, impulse.given);
    }
    void give(std::size_t k, const Vec3& more) {
        impulses[k].given = plus(impulses[k].given, more);
        left = minus(left, more);
    }
    static bool is_holder(ForceCause cause) { return cause == ForceCause::pins || cause == ForceCause::hands; }
    bool holds(const ForceSource& each) const { return is_holder(each.cause) && held[each.number] > 0; }
    /// Whether a source may have given what is left: hands, or else pins, which also bear the motion and the air of
    /// what they hold, and beside hands what their springs pull; without these seams; without these too air, and what
    /// was felt of colliders and other cloths; where nothing else acts, damping.
    bool may_take(std::size_t k) const {
        const auto any = [&](const auto& is) {
            for (std::size_t of = 0; of < sources.size(); ++of)
                if (is(of)) return true;
            return false;
        };
        const auto is_held = [&](std::size_t of) { return holds(sources[of]); };
        const auto is_handled = [&](std::size_t of) { return is_held(of) && sources[of].cause == ForceCause::hands; };
        const auto acts = [&](std::size_t of) {
            const ForceCause cause = sources[of].cause;
            const bool touches = cause == ForceCause::colliders || cause == ForceCause::other_cloths;
            return cause == ForceCause::air || cause == ForceCause::loads ||
                   (touches && length(impulses[of].given) > 0);
        };
        const auto is_seam = [&](std::size_t of) { return sources[of].cause == ForceCause::seams; };
        if (any(is_handled)) return is_handled(k);
        const auto damps = [&](std::size_t of) { return sources[of].cause == ForceCause::damping; };
        if (any(is_seam) && seams == SeamRest::first) return is_seam(k);
        if (any(is_held)) return is_held(k);
        if (any(is_seam) && seams == SeamRest::behind_pins) return is_seam(k);
        if (any(acts)) return acts(k);
        return any(damps) ? damps(k) : is_seam(k);
    }
    /// Gives what is left to those that may take it, to each as much as its impulse is of all.
    void close() {
        double sum = 0;
        std::vector<std::size_t> takers;
        for (std::size_t k = 0; k < sources.size(); ++k)
            if (may_take(k)) {
                takers.push_back(k);
                sum += length(impulses[k].given);
            }
        const Vec3 all = left;
        for (const std::size_t k : takers)
            give(k, times(sum > 0 ? length(impulses[k].given) / sum : 1.0 / static_cast<double>(takers.size()), all));
    }
};

}  // namespace

std::vector<ForceSource> force_sources(const SimulationModel& model, std::size_t index) {
    const ClothModel& cloth = model.cloths[index];
    const SceneDescription& scene = model.scene;
    std::vector<ForceSource> all;
    const auto add = [&](bool acts, ForceCause cause, const char* name) {
        if (acts) all.push_back({cause, 0, name});
    };
    add(length(strongest_gravity(scene)) > 0, ForceCause::gravity, "gravity");
    if (is_held(cloth))
        for (std::size_t k = 0; k < scene.cloths[index].pins.size(); ++k)
            all.push_back({ForceCause::pins, k, fmt::format("pins_{}", k)});
    if (std::ranges::any_of(cloth.dynamic_pins, [](const DynamicPin& pin) { return pin.hand.has_value(); }))
        all.push_back({ForceCause::hands, scene.cloths[index].pins.size(), "hands"});
    add(scene.wind.blows() || model.options.air, ForceCause::air, "air");
    add(cloth.load_depth > 0 || cloth.gas, ForceCause::loads, "loads");
    add(cloth.damping > 0, ForceCause::damping, "damping");
    for (std::size_t k = 0; k < scene.colliders.size(); ++k)
        all.push_back({ForceCause::colliders, k,
                       fmt::format("collider_{}_{}", k, collider_names[scene.colliders[k].shape.index()])});
    add(meets_others(model), ForceCause::other_cloths, "other_cloths");
    add(sewn_joints(model)[index] >= 0, ForceCause::seams, "seams");
    return all;
}

bool sums_impulses(const SceneDescription& scene) {
    return scene.forces ||
           std::ranges::any_of(scene.colliders, [](const Collider& each) { return each.mass.has_value(); });
}

std::uint32_t first_pin_row(const SceneDescription& scene) {
    return static_cast<std::uint32_t>(glsl::impulse_first + scene.colliders.size());
}

std::uint32_t impulse_sum_count(const SceneDescription& scene) {
    return first_pin_row(scene) + static_cast<std::uint32_t>(most_pins(scene));
}

std::uint32_t impulse_row_count(const SceneDescription& scene) {
    return impulse_sum_count(scene) * (scene.worst_forces ? glsl::impulse_tables : 1);
}

float impulse_units(const SimulationModel& model) {
    const double substep = 1 / (model.scene.time.fps * model.scene.solver.substeps);
    return static_cast<float>(0x1p20 / (substep * substep));
}

bool splits_pins(const SimulationModel& model) {
    if (!model.scene.forces) return false;
    const auto sewn_and_pinned = [&](const ClothModel& cloth) {
        return !cloth.sewn.empty() && !model.scene.cloths[index_of(model, cloth)].pins.empty();
    };
    return most_pins(model.scene) > (model.options.hands.empty() ? 1 : 0) ||
           std::ranges::count_if(model.cloths, sewn_and_pinned) > 1;
}

std::vector<glsl::uint> pin_numbers(const SimulationModel& model, std::size_t index) {
    const ClothModel& cloth = model.cloths[index];
    const std::vector<Pin>& pins = model.scene.cloths[index].pins;
    std::vector<glsl::uint> numbers(cloth.grid.particle_count());
    // A later pin overrides an earlier one on the particles that they share, as in ClothGeometry.
    for (std::size_t pin = 0; pin < pins.size(); ++pin) {
        const IndexBox& box = pins[pin].particles;
        for (std::uint32_t row = box.first[1]; row <= box.last[1]; ++row)
            for (std::uint32_t column = box.first[0]; column <= box.last[0]; ++column)
                numbers[cloth.grid.particle(column, row)] = static_cast<glsl::uint>(pin + 1);
    }
    return numbers;
}

glsl::MomentumPush momentum_push(const SimulationModel& model, const ClothModel& cloth, float sign) {
    glsl::MomentumPush push{cloth.grid.size(), sign, cloth.compression, {}, {}};
    const double frame = 1 / model.scene.time.fps;
    for (std::size_t direction = 0; direction < spring_directions.size(); ++direction) {
        const double stiffness = cloth.scheme.used_stiffness[direction];
        if (stiffness == 0 || !std::isfinite(stiffness)) continue;
        component(push.rest_length, direction) = static_cast<float>(cloth.stiffness_constant.rest_length[direction]);
        component(push.pull, direction) =
            static_cast<float>(0.5 * stiffness * frame * cloth.substep_length / cloth.inner_mass);
    }
    return push;
}

namespace {

/// Tells what is known of seams before a cloth's forces are.
struct KnownSeams {
    SeamRest rest{};
    Vec3 given{};  ///< N s
};

std::vector<ForceOnCloth> forces_with(const SimulationModel& model, std::size_t index, std::span<const std::byte> bytes,
                                      double mass, std::uint32_t frame, const KnownSeams& seams) {
    const ClothModel& cloth = model.cloths[index];
    const std::vector<ForceSource> sources = force_sources(model, index);
    const Impulses sums(bytes, cloth);
    const Vec3 fallen = fall(model, frame);
    const std::vector<Vec3> pulls = held_pulls(model, index, frame);
    Account account{sources, {}, sums.change(), held_masses(model, index, frame), seams.rest};
    for (const ForceSource& source : sources) {
        account.add(given_by(source, model, cloth, sums, mass, fallen));
        if (source.cause == ForceCause::seams) account.give(account.impulses.size() - 1, seams.given);
        if (Account::is_holder(source.cause))
            account.give(account.impulses.size() - 1,
                         times(-1, plus(times(account.held[source.number], fallen), pulls[source.number])));
    }
    account.close();
    std::vector<ForceOnCloth> forces;
    const double per_second = model.scene.time.fps;
    for (std::size_t k = 0; k < sources.size(); ++k) {
        const Impulse& own = account.impulses[k];
        forces.push_back({sources[k].name, times(per_second, own.given), std::nullopt});
        if (sources[k].cause == ForceCause::colliders) forces.back().moment = times(per_second, own.moment);
        if (!model.scene.worst_forces) continue;
        const std::optional<Impulse> worst = worst_of(sources[k], sums, 2 * impulse_sum_count(model.scene));
        if (!worst) continue;
        forces.back().worst = times(1 / cloth.substep_length, worst->given);
        if (forces.back().moment) forces.back().worst_moment = times(1 / cloth.substep_length, worst->moment);
    }
    return forces;
}

Vec3 force_of_seams(const std::vector<ForceOnCloth>& forces) {
    const auto found = std::ranges::find(forces, "seams", &ForceOnCloth::by);
    return found == forces.end() ? Vec3{} : found->force;
}

bool is_pinned(const SimulationModel& model, std::size_t cloth, std::uint32_t frame) {
    return std::ranges::any_of(held_masses(model, cloth, frame), [](double mass) { return mass > 0; });
}

}  // namespace

std::vector<ForceOnCloth> cloth_forces(const SimulationModel& model, std::size_t index,
                                       std::span<const std::byte> bytes, double mass, std::uint32_t frame) {
    if (frame == 0) return {};
    return forces_with(model, index, bytes, mass, frame, {});
}

void settle_seams(const SimulationModel& model, std::span<const std::span<const std::byte>> impulses,
                  std::uint32_t frame, std::vector<ClothStatistics>& statistics) {
    if (frame == 0 || !model.scene.forces || model.sewn_count == 0) return;
    const std::vector<int> joints = sewn_joints(model);
    for (const int joint : std::set<int>(joints.begin(), joints.end())) {
        if (joint < 0) continue;
        std::vector<std::size_t> all, pinned;
        for (std::size_t cloth = 0; cloth < joints.size(); ++cloth) {
            if (joints[cloth] != joint) continue;
            all.push_back(cloth);
            if (is_pinned(model, cloth, frame)) pinned.push_back(cloth);
        }
        const auto with = [&](std::size_t cloth, const KnownSeams& seams) {
            return forces_with(model, cloth, impulses[cloth], statistics[cloth].mass, frame, seams);
        };
        if (pinned.size() > 1)
            for (const std::size_t cloth : pinned) statistics[cloth].forces = with(cloth, {SeamRest::first, {}});
        Vec3 sum{};  // N: what seams give to all has to be nothing
        for (const std::size_t cloth : all) sum = plus(sum, force_of_seams(statistics[cloth].forces));
        const std::vector<std::size_t>& takers = pinned.empty() ? all : pinned;
        for (const std::size_t cloth : takers) {
            const Vec3 own =
                minus(force_of_seams(statistics[cloth].forces), times(1.0 / static_cast<double>(takers.size()), sum));
            statistics[cloth].forces = with(cloth, {SeamRest::last, times(1 / model.scene.time.fps, own)});
        }
    }
}

}  // namespace drape
