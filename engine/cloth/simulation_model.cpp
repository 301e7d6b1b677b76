#include "cloth/simulation_model.h"

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

bool SimulationModel::adaptive() const {
    return scene.solver.tolerance > 0 && scene.solver.iterations > 1 && method().iterates();
}

float SimulationModel::iteration_limit() const {
    const double limit = 0.99 * scene.solver.tolerance;
    return static_cast<float>(limit * limit);
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
    for (const ClothModel& cloth : cloths) {
        all.insert(all.end(), cloth.skipped.begin(), cloth.skipped.end());
        all.insert(all.end(), cloth.plan.skipped.begin(), cloth.plan.skipped.end());
    }
    return all;
}

std::vector<Compromise> SimulationModel::compromises() const {
    std::vector<Compromise> all;
    for (const ClothModel& cloth : cloths)
        all.insert(all.end(), cloth.plan.compromises.begin(), cloth.plan.compromises.end());
    return all;
}

}  // namespace drape
