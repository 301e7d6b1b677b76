#include "sweep/groups.h"

#include "cloth/members.h"

namespace drape::sweep {

namespace {

/// Cloths of more particles are simulated one by one (cloth/together.cpp), which a process each does as well.
constexpr std::uint64_t most_particles = 128 * 128;

/// Method `auto` takes those of many members together that need the same substeps: on a CPU smaller cloths gain by it.
constexpr std::uint64_t most_particles_by_auto_on_cpu = 24 * 24;

/// Scenes of one shape (cloth/members.h) for which the same method is used go on together.
struct GroupShape {
    SceneDescription scene;
    SolverMethod method;
};

/// Returns the shape of a scene that gains by going on with others.
std::optional<GroupShape> shape_of(const SceneDescription& scene, DeviceKind device) {
    const bool is_closed = scene.solver.method == SolverMethod::automatic;
    const std::uint64_t most = is_closed && device == DeviceKind::cpu ? most_particles_by_auto_on_cpu : most_particles;
    for (const Cloth& cloth : scene.cloths)
        if (std::uint64_t{cloth.grid[0]} * cloth.grid[1] > most) return std::nullopt;
    const SimulationModel model(scene, {.device = device});
    if (sharing_obstacle(model)) return std::nullopt;
    return GroupShape{scene, model.scene.solver.method};
}

bool alike(const GroupShape& first, const GroupShape& other) {
    return first.method == other.method && !shape_difference(first.scene, other.scene);
}

}  // namespace

bool can_be_grouped(const RunRequest& request, DeviceKind device) {
    return !request.draws() && !request.layers() && shape_of(asked_scene(request.scene), device);
}

std::vector<std::vector<GroupedRun>> groups_of(std::vector<GroupedRun> runs, DeviceKind device) {
    std::vector<std::vector<GroupedRun>> groups;
    std::vector<std::optional<GroupShape>> shapes;  // by group; nothing: its run goes on alone
    for (GroupedRun& run : runs) {
        std::optional<GroupShape> shape;
        try {
            if (!run.request.draws() && !run.request.layers()) shape = shape_of(asked_scene(run.request.scene), device);
        } catch (const Error&) {  // the run tells of it
        }
        std::size_t k = shape ? 0 : groups.size();
        while (k < groups.size() && (!shapes[k] || groups[k].size() == most_grouped || !alike(*shapes[k], *shape))) ++k;
        if (k == groups.size()) {
            groups.emplace_back();
            shapes.push_back(std::move(shape));
        }
        groups[k].push_back(std::move(run));
    }
    return groups;
}

}  // namespace drape::sweep
