// The steps of every frame of a scene as passes of a graph, and the resources that they work on.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "solver/attempt_pass.h"
#include "solver/cloth_layout.h"
#include "solver/kernel_choice.h"

namespace drape {

class ClothSolver {
  public:
    /// Makes no pipeline yet; the functions that add passes make those that the graph needs. Throws VulkanError when
    /// the device has not what a kernel that is asked for needs.
    /// `in_part`: passes are taken for those cloths that `write_present` names; then all must lie together.
    ClothSolver(const vulkan::Device& device, const SimulationModel& model,
                const Kernels& kernels = Kernels::automatic(), bool in_part = false);
    /// What the host needs to know to fill and to read the resources.
    ClothLayout& layout() { return layout_; }
    const ClothLayout& layout() const { return layout_; }

    /// Declares the images and host inputs that the scene and the wanted frame need, and only those.
    void declare(graph::Graph& graph, const FrameNeeds& needs) { declare(graph, needs, model_); }
    /// Declares those of a run of the same scene at other substeps, which must outlive the graph and what is added to
    /// it.
    void declare(graph::Graph& graph, const FrameNeeds& needs, const SimulationModel& run,
                 StateSet set = StateSet::run);
    /// Adds the passes of one frame.
    void add_simulation(graph::Graph& graph);
    /// Adds the passes that make the fields of meshes that deform, for a frame that is not simulated.
    void add_forms(graph::Graph& graph);
    /// Adds the passes of one of `steps`, where a frame that needs an inspection runs them one at a time.
    void add_step(graph::Graph& graph, const Step& step);
    /// Returns the steps of one frame of the run that was declared.
    std::vector<Step> steps() const;
    /// Adds passes that take every cloth's positions from the host (solver/position_upload.h).
    void add_positions(graph::Graph& graph);
    /// Adds the normals of every cloth (the graph drops them when nothing reads them).
    void add_normals(graph::Graph& graph);
    /// Adds copies to the host of an image of four floats per particle, every cloth's `what` (solver/readback_pass.h).
    void add_readback(graph::Graph& graph, Field image, std::string_view what);
    /// Adds copies to the host of what colliders gave to particles and of the tensions that the device keeps.
    void add_field_readback(graph::Graph& graph);
    /// Adds copies to the host of every member's bodies (cloth/bodies.h).
    void add_body_readback(graph::Graph& graph);
    /// Adds the statistics of every cloth (solver/statistics_pass.h).
    void add_statistics(graph::Graph& graph);
    /// Adds a pass that a closed loop needs around the attempts at a frame (solver/attempt_pass.h).
    void add_attempt(graph::Graph& graph, StateStep step);
    /// Adds the search for springs and triangles that the cutters cross.
    void add_cuts(graph::Graph& graph);
    /// Adds the search for springs that bear too much.
    void add_tears(graph::Graph& graph);
    /// The newest handles since `declare`.
    const std::vector<ClothState>& cloths() const { return cloths_; }
    std::size_t pipeline_count() const { return pipelines_.size(); }

  private:
    void declare_inputs(graph::Graph& graph);
    void declare_cloth(graph::Graph& graph, std::size_t index, const FrameNeeds& needs);
    void declare_together(graph::Graph& graph, Together& together, const FrameNeeds& needs);
    /// Returns the state of a cloth, or of cloths together of which it is the first one, without handles.
    ClothState state_of(std::size_t cloth) const;
    /// Gives a cloth the newest handles of the images that it shares.
    void take(std::size_t cloth);
    /// Makes the handles that a cloth made those of the images that it shares.
    void give(std::size_t cloth);
    void give_field(std::size_t cloth, Field field);
    /// Calls `add` once for cloths together, and for each of the others.
    template <class Add>
    void for_each_dispatch(const Add& add);
    template <class Add>
    void for_each_cloth(const Add& add);
    void add_dispatches(graph::Graph& graph, const Step& step);
    void add_step_of_bodies(graph::Graph& graph, const Step& step);
    /// `state` is null where contact is of all cloths at once.
    void add_step(graph::Graph& graph, ClothState* state, const Step& step);

    const SimulationModel& model_;
    const SimulationModel* run_;    ///< the run of the graph that is being built
    StateSet set_ = StateSet::run;  ///< the set that it works on
    bool in_part_;
    std::vector<KernelVerdict> verdicts_;
    ClothLayout layout_;
    Pipelines pipelines_;
    std::vector<ClothState> cloths_;
    /// Of cloths together, as ClothLayout has them: the handles of their images. A cloth's own handles to these are
    /// slices, and old until `take` renews them.
    std::vector<ClothState> together_;
    SceneInputs inputs_;
    ContactHandles contact_;
};

}  // namespace drape
