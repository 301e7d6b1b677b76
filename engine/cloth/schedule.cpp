#include "cloth/schedule.h"

namespace drape {

SimulationModel::SimulationModel(const SceneDescription& description, const ModelOptions& options)
    : scene(description),
      asked_method(description.solver.method),
      asked_tolerance(description.solver.tolerance),
      choice(choose_solver(description, options.device)),
      windy(description.wind.blows()) {
    scene.solver = choice.settings;
    for (std::size_t cloth = 0; cloth < scene.cloths.size(); ++cloth) cloths.emplace_back(scene, cloth, options);
    const Colliders& c = scene.colliders;
    collider_count = static_cast<int>(c.planes.size() + c.spheres.size() + c.boxes.size() + c.ellipsoids.size());
}

std::string SimulationModel::method_name() const {
    switch (scene.solver.method) {
        case SolverMethod::explicit_steps:
            return "explicit";
        case SolverMethod::line:
            return "line";
        default:
            return "relax";
    }
}

bool SimulationModel::adaptive() const {
    const SolverSettings& solver = scene.solver;
    return solver.tolerance > 0 && solver.iterations > 1 && solver.method != SolverMethod::explicit_steps;
}

float SimulationModel::iteration_limit() const {
    const double limit = 0.99 * scene.solver.tolerance;
    return static_cast<float>(limit * limit);
}

void SimulationModel::add_relax_steps(const ClothModel& cloth, std::uint32_t substep, std::vector<Step>& steps) const {
    const auto add = [&](StepKind kind, std::uint32_t work = 0) { steps.push_back({kind, substep, 0, work}); };
    if (cloth.has_release) add(StepKind::release);
    if (windy) add(StepKind::wind);
    add(StepKind::force);
    if (cloth.has_motion) add(StepKind::pin);
    add_bend_steps(cloth, substep, steps);
    add_iterations(StepKind::spring, static_cast<std::uint32_t>(cloth.springs.size()), substep, steps);
}

void SimulationModel::add_bend_steps(const ClothModel& cloth, std::uint32_t substep, std::vector<Step>& steps) const {
    // Once per substep: without a multiplier a second sweep would bend a second time as stiffly.
    for (std::uint32_t bend = 0; bend < cloth.bends.size(); ++bend) steps.push_back({StepKind::bend, substep, 0, bend});
    for (std::uint32_t twist = 0; twist < cloth.twists.size(); ++twist)
        steps.push_back({StepKind::twist, substep, 0, twist});
}

void SimulationModel::add_line_steps(const ClothModel& cloth, std::uint32_t substep, std::vector<Step>& steps) const {
    const auto add = [&](StepKind kind, std::uint32_t work = 0) { steps.push_back({kind, substep, 0, work}); };
    if (cloth.has_release) add(StepKind::release);
    if (windy) add(StepKind::wind);
    if (cloth.second_order) {
        add(StepKind::control);
        add(StepKind::predict);
    } else {
        add(StepKind::force);
    }
    if (cloth.has_motion) add(StepKind::pin);
    add_bend_steps(cloth, substep, steps);
    add_iterations(StepKind::line, static_cast<std::uint32_t>(cloth.lines.size()), substep, steps);
}

void SimulationModel::add_iterations(StepKind kind, std::uint32_t work_count, std::uint32_t substep,
                                     std::vector<Step>& steps) const {
    const bool per_iteration = scene.solver.collide == CollideWhen::iteration;
    for (std::uint32_t iteration = 0; iteration < scene.solver.iterations; ++iteration) {
        const bool last = iteration + 1 == scene.solver.iterations;
        const bool ends_frame = last && substep + 1 == scene.solver.substeps;
        const bool conditional = adaptive() && iteration > 0;
        for (std::uint32_t work = 0; work < work_count; ++work)
            steps.push_back({kind, substep, iteration, work, ends_frame, conditional});
        if (collider_count > 0 && per_iteration) {
            steps.push_back({StepKind::collide, substep, iteration, 0, false, conditional});
        } else if (collider_count > 0 && last) {
            steps.push_back({StepKind::collide, substep, iteration, 0});
        }
        if (adaptive() && !last) steps.push_back({StepKind::check, substep, iteration, 0, false, conditional});
    }
}

void SimulationModel::add_explicit_steps(const ClothModel& cloth, std::uint32_t substep,
                                         std::vector<Step>& steps) const {
    const auto add = [&](StepKind kind) { steps.push_back({kind, substep, 0, 0}); };
    if (cloth.has_release) add(StepKind::release);
    if (windy) add(StepKind::wind);
    add(StepKind::explicit_step);
    if (cloth.has_motion) add(StepKind::pin);
    if (collider_count > 0) add(StepKind::collide);
}

void SimulationModel::add_tethers(const ClothModel& cloth, std::uint32_t substep, std::vector<Step>& steps) const {
    if (cloth.tethers.empty()) return;
    steps.push_back({StepKind::tether, substep, 0, 0});
    if (collider_count > 0) steps.push_back({StepKind::collide, substep, scene.solver.iterations, 0});
}

std::vector<Step> SimulationModel::frame_steps(const ClothModel& cloth) const {
    std::vector<Step> steps;
    for (std::uint32_t substep = 0; substep < scene.solver.substeps; ++substep) {
        if (scene.solver.method == SolverMethod::explicit_steps) {
            add_explicit_steps(cloth, substep, steps);
        } else if (scene.solver.method == SolverMethod::line) {
            add_line_steps(cloth, substep, steps);
        } else {
            add_relax_steps(cloth, substep, steps);
        }
        add_tethers(cloth, substep, steps);
    }
    steps.push_back({StepKind::advance, scene.solver.substeps, 0, 0});
    return steps;
}

std::vector<SkippedWork> SimulationModel::skipped() const {
    std::vector<SkippedWork> all;
    if (!windy) all.push_back({"wind", "no wind in the scene"});
    const Colliders& c = scene.colliders;
    if (collider_count == 0) {
        all.push_back({"collision", "no colliders in the scene"});
    } else {
        const auto absent = [&](const char* kind, bool empty) {
            if (empty) all.push_back({std::string("collision with ") + kind, "the scene has none: specialised away"});
        };
        absent("planes", c.planes.empty());
        absent("spheres", c.spheres.empty());
        absent("boxes", c.boxes.empty());
        absent("ellipsoids", c.ellipsoids.empty());
        if (collider_count == 1)
            all.push_back({"collision rounds after the first", "one collider cannot overlap another"});
    }
    for (const ClothModel& cloth : cloths) all.insert(all.end(), cloth.skipped.begin(), cloth.skipped.end());
    return all;
}

}  // namespace drape
