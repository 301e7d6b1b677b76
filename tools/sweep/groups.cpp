#include "sweep/groups.h"

#include <memory>
#include <mutex>
#include <thread>

#include "cloth/members.h"
#include "drape/ensemble.h"

namespace drape::sweep {

namespace {

/// Cloths of more particles are simulated one by one (cloth/together.cpp), which a process each does as well.
constexpr std::uint64_t most_particles = 128 * 128;

bool gains(const SceneDescription& scene) {
    for (const Cloth& cloth : scene.cloths)
        if (std::uint64_t{cloth.grid[0]} * cloth.grid[1] > most_particles) return false;
    if (scene.solver.method == SolverMethod::automatic) return false;
    // A run proves of its own cloths that they did not cross, which members together do not.
    const SimulationModel model(scene);
    return !model.self_contact && !sharing_obstacle(model);
}

/// Leaves the ensemble when its run is over, however that ended.
class Membership {
  public:
    explicit Membership(EnsembleMember member) : member_(std::move(member)) {}
    ~Membership() { member_.run->leave(member_.number); }
    Membership(const Membership&) = delete;
    Membership& operator=(const Membership&) = delete;

  private:
    EnsembleMember member_;
};

}  // namespace

bool can_be_grouped(const RunRequest& request) { return !request.draws() && gains(asked_scene(request.scene)); }

std::vector<std::vector<GroupedRun>> groups_of(std::vector<GroupedRun> runs) {
    std::vector<std::vector<GroupedRun>> groups;
    std::vector<std::optional<SceneDescription>> shapes;  // by group; nothing: its run goes on alone
    for (GroupedRun& run : runs) {
        std::optional<SceneDescription> scene;
        try {
            scene = asked_scene(run.request.scene);
            if (run.request.draws() || !gains(*scene)) scene.reset();
        } catch (const Error&) {  // the run tells of it
        }
        std::size_t k = scene ? 0 : groups.size();
        while (k < groups.size() &&
               (!shapes[k] || groups[k].size() == most_grouped || shape_difference(*shapes[k], *scene)))
            ++k;
        if (k == groups.size()) {
            groups.emplace_back();
            shapes.push_back(std::move(scene));
        }
        groups[k].push_back(std::move(run));
    }
    return groups;
}

void run_group(const std::vector<GroupedRun>& group, const std::function<void(const GroupedEnd&)>& ended) {
    std::vector<SceneDescription> scenes;
    for (const GroupedRun& run : group) scenes.push_back(asked_scene(run.request.scene));
    const RunRequest& first = group.front().request;
    const Device device = device_of(first.scene, scenes.front(), false);
    EnsembleOptions options;
    options.kernels = first.scene.kernels;
    const auto shared = std::make_shared<EnsembleRun>(Ensemble(scenes, options, device));
    std::mutex mutex;
    std::vector<std::jthread> threads;
    for (std::size_t number = 0; number < group.size(); ++number)
        threads.emplace_back([&, number] {
            GroupedEnd end{group[number].index, false, nullptr};
            try {
                const Membership membership({shared, number});
                RunRequest request = group[number].request;
                request.shared = {device, {shared, number}};
                end.complete = run_scene(request).complete;
            } catch (...) {
                end.failure = std::current_exception();
            }
            const std::scoped_lock lock(mutex);
            ended(end);
        });
}

}  // namespace drape::sweep
