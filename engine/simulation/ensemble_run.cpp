#include "simulation/ensemble_run.h"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <numeric>
#include <thread>
#include <vector>

#include "cloth/members.h"
#include "simulation/device_parts.h"
#include "simulation/lane_server.h"
#include "simulation/scene_checks.h"
#include "solver/kernel_choice.h"

namespace drape {

/// Members by a named method have the frames of an ensemble.
class EnsembleRun::Frames : public Parts {
  public:
    explicit Frames(Ensemble given)
        : ensemble_(std::move(given)), present_(ensemble_.size()), begun_(present_), gone_(present_) {
        take_arrays();
    }

    void run(const std::function<void(std::size_t)>& simulate) override {
        std::exception_ptr thrown;
        {
            std::vector<std::jthread> threads;
            for (std::size_t member = 0; member < begun_.size(); ++member)
                threads.emplace_back([&, member] {
                    std::exception_ptr own;
                    try {
                        simulate(member);
                    } catch (...) {
                        own = std::current_exception();
                    }
                    leave(member, own, thrown);
                });
        }
        if (thrown) std::rethrow_exception(thrown);
    }

    void join(std::size_t member, FrameLoopOptions& options) override {
        options.next_elsewhere = [this, member] { return next(member); };
    }

  private:
    /// Returns a member's next frame, the first time frame 0, once all members that are still simulated ask for theirs.
    /// It is valid until then. Throws DeviceError where the ensemble is over.
    FrameElsewhere next(std::size_t member) {
        std::unique_lock lock(mutex_);
        if (begun_.at(member)) {
            const std::uint64_t round = round_;
            ++waiting_;
            step_if_all_wait();
            stepped_.wait(lock, [&] { return round_ > round; });
        }
        begun_[member] = true;
        if (failed_) std::rethrow_exception(failed_);
        return {frame(member), ensemble_.self_contact(member)};
    }

    /// The others no longer wait for this one.
    void leave(std::size_t member, const std::exception_ptr& own, std::exception_ptr& thrown) {
        const std::scoped_lock lock(mutex_);
        if (!thrown) thrown = own;
        if (gone_.at(member)) return;
        gone_[member] = true;
        --present_;
        step_if_all_wait();
    }

    void take_arrays() {
        positions_.clear();
        velocities_.clear();
        for (std::size_t cloth = 0; cloth < ensemble_.scene(0).cloths.size(); ++cloth) {
            positions_.push_back(ensemble_.positions(cloth));
            velocities_.push_back(ensemble_.velocities(cloth));
        }
    }

    /// Steps where all that are present wait. The lock is held.
    void step_if_all_wait() {
        if (waiting_ < present_ || present_ == 0) return;
        try {
            ensemble_.step();
            take_arrays();
        } catch (...) {
            failed_ = std::current_exception();
        }
        waiting_ = 0;
        ++round_;
        stepped_.notify_all();
    }

    FinishedFrame frame(std::size_t member) {
        FinishedFrame frame;
        frame.frame = ensemble_.frame(member);
        frame.statistics = ensemble_.statistics(member);
        frame.effort = ensemble_.effort(member);
        const auto of = [&](const MemberArray& array) {
            return std::span(array.data + member * array.member_stride, 4 * array.rows * array.columns);
        };
        for (const MemberArray& array : positions_) frame.positions.push_back(of(array));
        for (const MemberArray& array : velocities_) frame.velocities.push_back(of(array));
        return frame;
    }

    Ensemble ensemble_;
    std::mutex mutex_;
    std::condition_variable stepped_;
    std::size_t waiting_ = 0, present_;
    std::vector<bool> begun_, gone_;
    std::uint64_t round_ = 0;
    std::exception_ptr failed_;
    std::vector<MemberArray> positions_, velocities_;  ///< by cloth
};

namespace {

/// Each member's model must stay where it is: a server knows them all by their addresses.
std::vector<std::unique_ptr<SimulationModel>> models_of(const std::vector<SceneDescription>& scenes,
                                                        const Device& device) {
    std::vector<std::unique_ptr<SimulationModel>> models;
    const ModelOptions options{.device = device_kind(device.info())};
    for (const SceneDescription& scene : scenes)
        models.push_back(std::make_unique<SimulationModel>(checked_scene(scene), options));
    return models;
}

std::vector<const SimulationModel*> pointers_to(const std::vector<std::unique_ptr<SimulationModel>>& models) {
    std::vector<const SimulationModel*> all;
    for (const auto& model : models) all.push_back(model.get());
    return all;
}

}  // namespace

/// Members by `auto` keep their own loops.
class EnsembleRun::Lanes : public Parts {
  public:
    Lanes(std::vector<std::unique_ptr<SimulationModel>> models, const Kernels& kernels, const Device& device)
        : device_(device),
          models_(std::move(models)),
          server_(device_.parts_->device, pointers_to(models_), {.normals = false, .kernels = kernels}) {
        check_bytes(device_.parts_->device, server_.bytes_each(), models_.size());
        server_.allocate();
    }

    void run(const std::function<void(std::size_t)>& simulate) override {
        std::vector<std::size_t> all(models_.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        server_.serve(all, simulate);
    }
    void join(std::size_t member, FrameLoopOptions& options) override { options.lane = &server_.lane(member); }

  private:
    Device device_;
    std::vector<std::unique_ptr<SimulationModel>> models_;
    LaneServer server_;
};

EnsembleRun::EnsembleRun(const std::vector<SceneDescription>& scenes, const Kernels& kernels, const Device& device) {
    if (scenes.empty() || scenes.front().solver.method != SolverMethod::automatic) {
        EnsembleOptions options;
        options.kernels = kernels;
        parts_ = std::make_unique<Frames>(Ensemble(scenes, options, device));
        return;
    }
    for (const SceneDescription& scene : scenes)
        if (const auto found = shape_difference(scenes.front(), scene))
            throw Error("scenes of unlike shape cannot go on together: " + *found);
    auto models = models_of(scenes, device);
    for (const auto& model : models) {
        if (const auto obstacle = sharing_obstacle(*model))
            throw Error("these scenes cannot go on together: " + *obstacle);
        if (model->scene.solver.method != models.front()->scene.solver.method)
            throw Error("scenes for which method auto chooses unlike methods cannot go on together");
    }
    parts_ = std::make_unique<Lanes>(std::move(models), kernels, device);
}
EnsembleRun::~EnsembleRun() = default;

void EnsembleRun::run(const std::function<void(std::size_t)>& simulate) { parts_->run(simulate); }

}  // namespace drape
