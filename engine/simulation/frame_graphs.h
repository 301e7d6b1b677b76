// The graphs of the work that a device does for a run, or for the runs of several members together: frames, by their
// contents, and steps of the state. A graph is planned when the resources are allocated, or when it is first asked for,
// and recorded when it is first submitted.
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
    bool draw = true;           ///< draw what PictureOptions says
    bool draws_beside = false;  ///< they are drawn by another device (pictures.h)
    bool arrays_later = false;  ///< the receiver takes or computes arrays from what was read back
    bool normals = false;       ///< hand out arrays of normals
    bool fields = false;        ///< hand out tensions and contact forces
    bool statistics = false;    ///< compute statistics of every frame that is handed out
    bool judges = false;        ///< compute statistics of every frame that is simulated
    Kernels kernels = Kernels::automatic();
    std::function<void()> meanwhile;      ///< called whenever a frame has been submitted to the device
    graph::BarrierFilter barrier_filter;  ///< for canary tests only
};

/// What one graph does, in the order of these members.
struct FrameContents {
    StateSet set = StateSet::run;
    bool simulates = false;
    std::uint32_t substeps = 0;        ///< 0: those of the scene
    bool cuts = false, tears = false;  ///< search for these
    bool hands_out = false;
    bool counts = false;                                     ///< compute the statistics
    auto operator<=>(const FrameContents&) const = default;  // NOLINT: clang-tidy 14 takes its 0 for a pointer
    bool nothing() const { return !simulates && !cuts && !tears && !hands_out && !counts; }
};

struct PlannedGraph {
    graph::Graph graph;
    graph::Plan plan;
    std::unique_ptr<graph::RecordedPlan> recorded;
};

class FrameGraphs {
  public:
    /// `members`: one model, or several of one shape (cloth/members.h); they must outlive this object. Throws
    /// VulkanError where the device lacks what a kernel needs.
    FrameGraphs(const vulkan::Device& device, const std::vector<const SimulationModel*>& members,
                const FrameOptions& options);

    const FrameOptions& options() const { return options_; }
    /// `joint` returns the model of all members together, `member` that of one.
    const SimulationModel& joint() const { return *joint_; }
    const SimulationModel& member(std::size_t number) const { return *members_[number]; }
    /// These return the same models with this number of substeps; 0: the scene's number.
    const SimulationModel& joint_at(std::uint32_t substeps);
    const SimulationModel& member_at(std::size_t number, std::uint32_t substeps);
    /// Has the models of other numbers of substeps follow what actions changed in a member's.
    void take_actions(std::size_t number);
    std::size_t member_count() const { return members_.size(); }
    std::size_t cloths_each() const { return members_.front()->cloths.size(); }
    /// Returns whether a submit may do work for some members and not for others.
    bool in_part() const { return members_.size() > 1 && joint_->closed_loop(); }

    /// Returns the contents of a frame, with statistics as the options ask for. `first`: it is frame 0.
    FrameContents contents(bool simulates, bool hands_out, bool first = false) const;
    /// Returns the bytes on the device of all graphs that are known to be needed.
    std::uint64_t bytes();
    /// Allocates the resources, and fills them with the start. Throws VulkanError before allocating if they exceed the
    /// budget.
    void allocate();
    /// Reallocates the resources at the sizes that they need now, and goes on from this state. No submit may be in
    /// flight.
    void rebuild(const SimulationState& state);
    /// Records the drawing again after a cut, since the recording contains how much is drawn.
    void draw_anew();

    const PlannedGraph& planned(const FrameContents& contents);
    VkCommandBuffer commands(const FrameContents& contents, std::uint32_t slot);
    VkCommandBuffer commands(StateStep step, StateSet set, std::uint32_t slot);
    /// Returns the times that the device measured in the slot's last submit of a frame.
    std::vector<StageTime> timings(const FrameContents& contents, std::uint32_t slot) const;

    ClothLayout& layout() { return solver_.layout(); }
    const ClothLayout& layout() const { return solver_.layout(); }
    ClothRaster& raster() { return raster_; }
    const graph::ResourcePool& pool() const { return *pool_; }

  private:
    /// The members' models with one number of substeps.
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
    bool planned_all_ = false;  ///< all graphs known to be needed are planned
    std::unique_ptr<graph::ResourcePool> pool_;
};

/// Throws VulkanError, which says how many fit, where the device has no room for `count` members like these together.
void check_room(const vulkan::Device& device, FrameGraphs& graphs, std::size_t count);

}  // namespace drape
