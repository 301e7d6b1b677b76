#include "cloth/simulation_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "base/vectors.h"
#include "cloth/rungs.h"
#include "cloth/texels.h"
#include "shared/collider_types.h"
#include "world/contact_shape.h"
#include "world/weather.h"

namespace drape {

SimulationModel::SimulationModel(const SceneDescription& description, const ModelOptions& wanted)
    : scene(description),
      asked_method(description.solver.method),
      asked_tolerance(description.solver.tolerance),
      choice(choose_solver(description, wanted.device)),
      options(wanted),
      windy(has_weather(description) || wanted.air || wanted.weight),
      weighs(gravity_changes(description) || wanted.weight) {
    scene.solver = choice.settings;
    add_cloths(cloths_meet(scene) ? start_crossings(scene) : std::vector<StartCrossing>{});
    std::ranges::stable_sort(scene.colliders, {}, &Collider::kind);
    mesh_fields = MeshFields(scene);
    add_colliders();
}

SimulationModel::SimulationModel(const SimulationModel& run, std::uint32_t substeps)
    : scene(run.scene),
      asked_method(run.asked_method),
      asked_tolerance(run.asked_tolerance),
      choice(run.choice),
      options(run.options),
      kept_colliders(run.kept_colliders),
      bodies(run.bodies),
      mesh_fields(run.mesh_fields),
      windy(run.windy),
      weighs(run.weighs),
      colliders_move(run.colliders_move) {
    scene.solver.substeps = substeps;
    add_cloths(run.self_contact ? run.self_contact->crossed : std::vector<StartCrossing>{});
    for (std::size_t cloth = 0; cloth < cloths.size(); ++cloth)
        cloths[cloth].collider_list = run.cloths[cloth].collider_list;
}

SimulationModel::SimulationModel(const std::vector<const SimulationModel*>& members)
    : scene(members.front()->scene),
      asked_method(members.front()->asked_method),
      asked_tolerance(members.front()->asked_tolerance),
      choice(members.front()->choice),
      options(members.front()->options),
      mesh_fields(members.front()->mesh_fields),
      windy(members.front()->windy),
      weighs(members.front()->weighs),
      member_count(members.size()) {
    scene.cloths.clear();
    for (std::size_t member = 0; member < members.size(); ++member) {
        const SimulationModel& one = *members[member];
        for (std::size_t cloth = 0; cloth < one.cloths.size(); ++cloth) {
            ClothModel& model = cloths.emplace_back(one.cloths[cloth]);
            model.name = fmt::format("{}/{}", member, model.name);
            model.member = member;
            model.collider_list += kept_colliders.size();
            for (Sewn& each : model.sewn) {
                each.sewn.at.z += static_cast<int>(sewn_count);
                if (each.sewn.between.x >= 0) each.sewn.between.x += static_cast<int>(sewn_count);
            }
            if (model.gas)
                for (int* const at : {&model.gas->first, &model.gas->own}) *at += static_cast<int>(gas_sum_count);
            scene.cloths.push_back(one.scene.cloths[cloth]);
            scene.cloths.back().name = model.name;
        }
        bodies.push_back(one.bodies.front());
        bodies.back().first_list = kept_colliders.size();
        sewn_count += one.sewn_count;
        gas_sum_count += one.gas_sum_count;
        kept_colliders.insert(kept_colliders.end(), one.kept_colliders.begin(), one.kept_colliders.end());
        colliders_move = colliders_move || one.colliders_move;
    }
    if (!members.front()->self_contact) return;
    std::vector<const SelfContact*> contacts;
    for (const SimulationModel* const member : members) contacts.push_back(&*member->self_contact);
    self_contact.emplace(contacts);
}

void SimulationModel::take_actions(const SimulationModel& acted) {
    scene.wind = acted.scene.wind;
    scene.gravity_keys = acted.scene.gravity_keys;
    for (std::size_t k = 0; k < scene.colliders.size(); ++k) {
        scene.colliders[k].path = acted.scene.colliders[k].path;
        for (std::vector<KeptCollider>& list : kept_colliders) list[k].collider.path = scene.colliders[k].path;
    }
    for (std::size_t k = 0; k < bodies.front().bodies.size(); ++k)
        bodies.front().bodies[k].acts = acted.bodies.front().bodies[k].acts;
    for (std::size_t k = 0; k < cloths.size(); ++k) {
        cloths[k].dynamic_pins = acted.cloths[k].dynamic_pins;
        scene.cloths[k].loads = acted.scene.cloths[k].loads;
    }
}

void SimulationModel::add_colliders() {
    colliders_move = std::ranges::any_of(scene.colliders, [](const Collider& each) { return each.moves(); });
    for (std::size_t cloth = 0; cloth < scene.cloths.size(); ++cloth) {
        const Cloth& shape = scene.cloths[cloth];
        const std::vector<WayOut> out = ways_out(shape, scene.colliders, recovery_speed);
        std::vector<KeptCollider> kept;
        for (std::size_t k = 0; k < out.size(); ++k) kept.push_back({contact_shape(shape, scene.colliders[k]), out[k]});
        const auto list = std::ranges::find(kept_colliders, kept);
        cloths[cloth].collider_list = static_cast<std::size_t>(list - kept_colliders.begin());
        if (list == kept_colliders.end()) kept_colliders.push_back(std::move(kept));
    }
    bodies = {bodies_of(scene, kept_colliders.size())};
}

void SimulationModel::add_cloths(const std::vector<StartCrossing>& crossed) {
    for (std::size_t cloth = 0; cloth < scene.cloths.size(); ++cloth) cloths.emplace_back(scene, cloth, options);
    closings = closing_times(scene);
    for (const ClothModel& cloth : cloths)
        for (const Sewn& each : cloth.sewn)
            sewn_count = std::max(sewn_count, static_cast<std::size_t>(each.sewn.at.z) + 1);
    if (sewn_count > 0 && (options.holds || options.weight || !options.hands.empty()))
        throw std::invalid_argument(
            "expected no seams where actions let pins go, take particles or turn gravity: they do not follow these "
            "yet");
    gas_sum_count = add_gas(scene, cloths);
    share_kicks();
    for (ClothModel& cloth : cloths)
        if (cloth.gas) cloth.wind.gas_sign = static_cast<float>(cloth.gas->sign);
    if (cloths_meet(scene)) self_contact.emplace(scene, cloths, crossed);
}

/// Lets what the loads and the gas of one cloth give to a sewn particle move all that are sewn there.
void SimulationModel::share_kicks() {
    const auto is_loaded = [](const Cloth& cloth) { return !cloth.loads.empty(); };
    if (sewn_count == 0 || (scene.gas.empty() && std::ranges::none_of(scene.cloths, is_loaded))) return;
    std::vector<Vec3> kicks(sewn_count);
    const auto vector = [](const glsl::vec4& v) { return Vec3{double{v.x}, double{v.y}, double{v.z}}; };
    for (const ClothModel& cloth : cloths)
        for (const Sewn& each : cloth.sewn) {
            Vec3& sum = kicks[static_cast<std::size_t>(each.sewn.at.z)];
            sum = plus(sum, times(each.part, vector(each.kick)));
        }
    for (ClothModel& cloth : cloths)
        for (const Sewn& each : cloth.sewn) {
            if (each.sewn.between.y == 0) continue;
            cloth.scheme.starts.resize(cloth.position.size(), cloth.scheme.start);
            glsl::vec4& start = cloth.scheme.starts[each.particle];
            Vec3 whole = kicks[static_cast<std::size_t>(each.sewn.at.z)];
            if (each.sewn.between.x >= 0) {
                const double own = double{each.sewn.weights.w};
                whole = plus(times(own, whole), times(1 - own, kicks[static_cast<std::size_t>(each.sewn.between.x)]));
            }
            const Vec3 more = minus(whole, vector(each.kick));
            start = texel(plus(vector(start), more), double{start.w});
        }
}

SimulationModel::StretchLimits SimulationModel::stretch_limits() const {
    const SolverSettings& solver = scene.solver;
    return {solver.tolerance > 0 ? solver.tolerance : default_tolerance,
            solver.tolerance_worst > 0 ? solver.tolerance_worst : default_tolerance_worst};
}

std::uint32_t SimulationModel::companion_substeps(std::uint32_t substeps) const {
    return drape::companion_substeps(row_of(scene.solver.method), substeps);
}

std::uint32_t SimulationModel::most_substeps() const {
    const std::uint32_t own = scene.solver.substeps;
    if (closed_loop()) return substep_rungs(row_of(scene.solver.method)).back();
    return has_companions() ? std::max(own, companion_substeps(own)) : own;
}

bool SimulationModel::ends_iterations() const {
    return scene.solver.tolerance > 0 && scene.solver.iterations > 1 && method().iterates();
}

/// On a GPU all springs of an iteration are one pass, and asking whether to skip one costs as much as ten empty passes
/// (docs/devices.md).
bool SimulationModel::iterates_cheaply() const {
    constexpr std::uint64_t least_particles = 256 * 256;
    const auto is_large = [](const Cloth& cloth) {
        return std::uint64_t{cloth.grid[0]} * cloth.grid[1] >= least_particles;
    };
    return options.device == DeviceKind::gpu && scene.solver.method == SolverMethod::relax &&
           std::ranges::none_of(scene.cloths, is_large);
}

bool SimulationModel::adaptive() const { return ends_iterations() && !iterates_cheaply(); }

float SimulationModel::iteration_limit() const {
    const double limit = 0.99 * scene.solver.tolerance;
    return static_cast<float>(limit * limit);
}

std::vector<SkippedWork> SimulationModel::skipped() const {
    std::vector<SkippedWork> all;
    if (!windy) all.push_back({"wind", "no wind in the scene"});
    if (scene.gas.empty()) all.push_back({"gas", "no gas in the scene"});
    if (!bodies.front().bodies.empty() && !bodies.front().meet)
        all.push_back({"contact of bodies", "one body, and no collider but planes, whose contact its motion has"});
    if (scene.colliders.empty()) {
        all.push_back({"collision", "no colliders in the scene"});
    } else {
        for (int kind = 0; kind < glsl::collider_kind_count; ++kind)
            if (std::ranges::find(scene.colliders, kind, &Collider::kind) == scene.colliders.end())
                all.push_back(
                    {fmt::format("collision with {}", collider_lists[kind]), "the scene has none: specialised away"});
        if (options.skip)
            all.push_back({"contact of particles with colliders out of their reach",
                           "bounds tell, in every substep, and leave the same bits"});
        if (mesh_fields.deform())
            all.push_back({"a tree over the triangles of a mesh in a form that it had in one of the last frames",
                           "the one that was made then is taken again"});
        if (scene.colliders.size() == 1)
            all.push_back({"collision rounds after the first", "one collider cannot overlap another"});
    }
    if (ends_iterations() && iterates_cheaply())
        all.push_back({"questions whether a substep needs another iteration",
                       "on a GPU the iterations of small cloth cost less: all are done"});
    if (!has_companions())
        all.push_back({"the companion run",
                       closed_loop()
                           ? "solver.estimate_error is false"
                           : "the position error of a method that is named is estimated where solver.estimate_error "
                             "says so"});
    for (const ClothModel& cloth : cloths) {
        all.insert(all.end(), cloth.skipped.begin(), cloth.skipped.end());
        all.insert(all.end(), cloth.scheme.skipped.begin(), cloth.scheme.skipped.end());
    }
    return all;
}

std::vector<Compromise> SimulationModel::compromises() const {
    std::vector<Compromise> all = mesh_fields.compromises(scene);
    if (closed_loop()) return all;  // a closed loop judges what its steps do not follow
    for (const ClothModel& cloth : cloths)
        all.insert(all.end(), cloth.scheme.compromises.begin(), cloth.scheme.compromises.end());
    return all;
}

}  // namespace drape
