// The graphs of what a device does for a run, or for the runs of several members together: frames by their contents,
// and steps of the state. They are planned when the resources are allocated, or when they are first asked for, and
// recorded when they are first submitted.
#pragma once

#include <compare>
#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "cloth/state_sets.h"
#include "drape/simulation.h"
#include "picture/cloth_raster.h"
#include "solver/cloth_solver.h"

namespace drape {

struct FrameOptions : PictureOptions {
    bool draw = true;           ///< colour images are wanted
    bool draws_beside = false;  ///< they are, but another device makes them (pictures.h)
    bool velocities = false;    ///< arrays of velocities are wanted; needs statistics
    bool arrays_later = false;  ///< they are taken, or computed, of what was read back by whoever wants them
    bool normals = false;       ///< arrays of normals are wanted
    bool statistics = false;    ///< statistics of every frame handed out are wanted
    bool judges = false;        ///< and of every frame that is simulated
    Kernels kernels = Kernels::automatic();
    std::function<void()> meanwhile;      ///< called whenever the device has got a frame to simulate
    graph::BarrierFilter barrier_filter;  ///< canary tests only
};

/// What one graph does, in this order.
struct FrameContents {
    StateSet set = StateSet::run;
    bool simulates = false;
    std::uint32_t substeps = 0;        ///< 0: those of the scene
    bool cuts = false, tears = false;  ///< they are searched for
    bool hands_out = false;
    bool counts = false;  ///< the statistics
    auto operator<=>(const FrameContents&) const = default;
    bool nothing() const { return !simulates && !cuts && !tears && !hands_out && !counts; }
};

struct PlannedGraph {
    graph::Graph graph;
    graph::Plan plan;
    std::unique_ptr<graph::RecordedPlan> recorded;
};

class FrameGraphs {
  public:
    /// `members`: one model, or several of one shape (cloth/members.h); they must outlive it. Throws VulkanError where
    /// the device has not what a kernel needs.
    FrameGraphs(const vulkan::Device& device, const std::vector<const SimulationModel*>& members,
                const FrameOptions& options);

    const FrameOptions& options() const { return options_; }
    /// Returns the model of all members, and one's.
    const SimulationModel& joint() const { return *joint_; }
    const SimulationModel& member(std::size_t number) const { return *members_[number]; }
    /// Returns them at so many substeps; 0: those of the scene.
    const SimulationModel& joint_at(std::uint32_t substeps);
    const SimulationModel& member_at(std::size_t number, std::uint32_t substeps);
    std::size_t member_count() const { return members_.size(); }
    std::size_t cloths_each() const { return members_.front()->cloths.size(); }
    /// Returns whether work is done for some members and not for others.
    bool in_part() const { return members_.size() > 1 && joint_->closed_loop(); }

    /// Returns the graph of a frame whose statistics are wanted as the options say. `first`: it is frame 0.
    FrameContents contents(bool simulates, bool hands_out, bool first = false) const;
    /// Returns the bytes on the device of all that is known to be needed.
    std::uint64_t bytes();
    /// Allocates it, and fills it with the start. Throws VulkanError where it is over budget, before it allocates.
    void allocate();
    /// Gives the resources the sizes that they now are to have, and goes on with this state. Nothing may be in flight.
    void rebuild(const SimulationState& state);
    /// Draws what cuts have left: the recording says how much.
    void draw_anew();

    const PlannedGraph& planned(const FrameContents& contents);
    VkCommandBuffer commands(const FrameContents& contents, std::uint32_t slot);
    VkCommandBuffer commands(StateStep step, StateSet set, std::uint32_t slot);
    /// Returns the device's times of the slot's last submit of a frame.
    std::vector<StageTime> timings(const FrameContents& contents, std::uint32_t slot) const;

    ClothLayout& layout() { return solver_.layout(); }
    const ClothLayout& layout() const { return solver_.layout(); }
    ClothRaster& raster() { return raster_; }
    const graph::ResourcePool& pool() const { return *pool_; }

  private:
    /// The members' models at a number of substeps.
    struct ModelsAt {
        std::vector<std::unique_ptr<SimulationModel>> own;
        std::unique_ptr<SimulationModel> joint;  ///< null where there is one member
    };
    using SetStep = std::pair<StateSet, StateStep>;

    ModelsAt& models_at(std::uint32_t substeps);
    std::vector<FrameContents> known_contents() const;
    void plan_known();
    void fit_raster();
    PlannedGraph plan(const FrameContents& contents);
    void add_hand_out(graph::Graph& graph);
    VkCommandBuffer commands(PlannedGraph& planned, std::uint32_t slot) const;
    std::vector<std::pair<const graph::Graph*, const graph::Plan*>> plans() const;

    const vulkan::Device& device_;
    std::vector<const SimulationModel*> members_;
    FrameOptions options_;
    std::unique_ptr<SimulationModel> joined_;  ///< null where there is one member
    const SimulationModel* joint_;
    ClothSolver solver_;
    ClothRaster raster_;
    std::map<std::uint32_t, ModelsAt> models_;
    std::map<FrameContents, PlannedGraph> frames_;
    std::map<SetStep, PlannedGraph> steps_;
    bool planned_all_ = false;  ///< what is known to be needed is planned
    std::unique_ptr<graph::ResourcePool> pool_;
};

/// Throws VulkanError, telling how many fit, where `count` members like these have no room on the device together.
void check_room(const vulkan::Device& device, FrameGraphs& graphs, std::size_t count);

}  // namespace drape
