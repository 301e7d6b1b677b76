// Frame loops of an ensemble's members share the dispatches of what they ask for alike: a server has the state of all
// of them on the device, waits until every loop asks for something or is done, and then takes those that ask for the
// same parts together, the many before the few. Which loops go together changes no bit of any.
#pragma once

#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <vector>

#include "graph/executor.h"
#include "simulation/loop_lane.h"
#include "simulation/member_runs.h"
#include "solver/cloth_solver.h"

namespace drape {

class LaneServer {
  public:
    /// `models`: of one shape (cloth/members.h) and one method; they must outlive it.
    LaneServer(const vulkan::Device& device, const std::vector<const SimulationModel*>& models,
               const MemberRunOptions& options);
    ~LaneServer();
    LaneServer(const LaneServer&) = delete;
    LaneServer& operator=(const LaneServer&) = delete;

    /// Returns whether all cloths of these models can be taken together.
    static bool fits(const vulkan::Device& device, const std::vector<const SimulationModel*>& models,
                     const MemberRunOptions& options);
    /// Returns the bytes on the device of each of them.
    std::uint64_t bytes_each() const;
    void allocate();

    LoopLane& lane(std::size_t place);
    /// Takes a member to its start, in all sets.
    void reset(std::size_t place);
    /// Serves the loops in `run(place)`, each on a thread of its own, until all have returned. Throws what one of them
    /// threw, and what the device did.
    void serve(const std::vector<std::size_t>& places, const std::function<void(std::size_t place)>& run);
    std::size_t pass_count() const;

  private:
    class Lane;
    struct Planned {
        graph::Graph graph;
        graph::Plan plan;
        std::unique_ptr<graph::RecordedPlan> recorded;
    };
    /// A frame of all members at one number of substeps.
    struct Rung {
        std::unique_ptr<SimulationModel> model;
        Planned planned;
    };
    struct Waiting {
        const LaneWork* work = nullptr;  ///< null: it waits for nothing
        std::uint32_t slot = 0;
    };

    bool has(StateSet set) const { return has_set(all_, set); }
    void plan_looks();
    void plan_attempts();
    std::vector<std::pair<const graph::Graph*, const graph::Plan*>> plans() const;
    void record(Planned& planned) const;
    Rung& rung(StateSet set, std::uint32_t substeps);
    void plan_rung(StateSet set, Rung& rung);
    VkCommandBuffer commands_of(const LanePart& part);

    void submit(std::size_t place, std::uint32_t slot, const LaneWork& work);
    /// Returns those that wait for the same as most do.
    std::vector<std::size_t> largest_group() const;
    void take(const std::vector<std::size_t>& places);
    void write(const LaneWork& first, const std::vector<std::size_t>& places);
    void write_frame(const std::vector<std::size_t>& places, std::uint32_t substeps);
    void write_look(const std::vector<std::size_t>& places);
    void write_changes(const std::vector<std::size_t>& places);
    void hand_out(const LaneWork& first, const std::vector<std::size_t>& places);
    SimulationState download(std::size_t place) const;
    void upload(std::size_t place, const SimulationState& state);

    const vulkan::Device& device_;
    std::vector<const SimulationModel*> models_;
    MemberRunOptions options_;
    std::size_t cloths_each_;
    SimulationModel all_;
    ClothSolver solver_;
    Planned look_, statistics_;
    std::array<std::array<Planned, attempt_step_count>, state_set_count> attempts_;
    std::array<std::map<std::uint32_t, Rung>, state_set_count> rungs_;
    std::unique_ptr<graph::ResourcePool> pool_;
    vulkan::FrameSlots slots_;
    std::vector<std::unique_ptr<Lane>> lanes_;
    std::vector<FrameInputs> inputs_;  ///< by member
    FrameInputs joined_;

    // The lock is about what follows.
    std::mutex mutex_;
    std::condition_variable asked_;                  ///< a loop asks for something, or is done
    std::vector<std::condition_variable> answered_;  ///< by member
    std::vector<Waiting> waiting_;                   ///< by member
    std::size_t running_ = 0;                        ///< loops that neither wait nor are done
    std::exception_ptr failed_;
};

}  // namespace drape
