// The steps of every frame of a scene as passes of a graph, and the state that they work on.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "cloth/cloth_statistics.h"
#include "cloth/cut_topology.h"
#include "cloth/frame_judgement.h"
#include "solver/attempt_pass.h"
#include "solver/kernel_choice.h"
#include "solver/pass_kit.h"

namespace drape {

/// What the host had put into a cloth's fields before a cut, by field.
struct CutImages {
    std::array<std::vector<std::byte>, field_count> fields;
    std::size_t index_count, vertex_count;  ///< drawn
};

/// Whether what is drawn of a cloth after a cut needs other buffers.
bool draws_outgrown(const CutImages& before, const CutTopology& topology);

class ClothSolver {
  public:
    /// Makes no pipeline yet: `add_*` makes what the graph needs.
    /// Throws VulkanError when the device has not what a kernel that is asked for needs.
    ClothSolver(const vulkan::Device& device, const SimulationModel& model,
                const Kernels& kernels = Kernels::automatic());
    /// Those that its steps may use.
    const Kernels& kernels() const { return kernels_; }

    /// What cuts made of each cloth; what changes them acts from the next `declare` or `upload_cut` on.
    std::vector<CutTopology>& topologies() { return topologies_; }
    const std::vector<CutTopology>& topologies() const { return topologies_; }
    /// Declares the images and host inputs that the scene and what is wanted of the frame need, and only those.
    void declare(graph::Graph& graph, const FrameNeeds& needs) { declare(graph, needs, model_); }
    /// Likewise for a run of the same scene at other substeps, which must outlive the graph and what is added to it.
    void declare(graph::Graph& graph, const FrameNeeds& needs, const SimulationModel& run);
    /// Adds the passes of one frame.
    void add_simulation(graph::Graph& graph);
    /// Adds what takes every cloth's positions from the host (solver/position_upload.h).
    void add_positions(graph::Graph& graph);
    /// Adds the normals of every cloth (the graph drops them when nothing reads them).
    void add_normals(graph::Graph& graph);
    /// Adds the statistics of every cloth (solver/statistics_pass.h), to be read by `statistics`.
    void add_statistics(graph::Graph& graph);
    /// Closed loops: adds what surrounds the attempts at a frame (solver/attempt_pass.h).
    void add_attempt(graph::Graph& graph, AttemptStep step);
    /// Per cloth, m, of the slot's last comparison.
    std::vector<double> differences(const graph::ResourcePool& pool, std::uint32_t slot) const;
    /// Adds the search for springs and triangles that the cutters cross.
    void add_cuts(graph::Graph& graph);
    /// The newest handles since `declare`.
    const std::vector<ClothState>& cloths() const { return cloths_; }

    /// Uploads the initial state, masks, triangles and pins to whatever of them the pool holds.
    void upload(const graph::ResourcePool& pool) const;
    /// The fields of all cloths that are state, by resource: to carry the state over to new resources.
    std::map<std::string, std::vector<std::byte>> download_state(const graph::ResourcePool& pool) const;
    void upload_state(const graph::ResourcePool& pool,
                      const std::map<std::string, std::vector<std::byte>>& state) const;
    /// Uploads what of a cut cloth's fields differs from `before`.
    void upload_cut(const graph::ResourcePool& pool, std::size_t cloth, const CutImages& before) const;
    /// What `upload_cut` compares with: copies of the host's side.
    CutImages cut_images(std::size_t cloth) const;
    /// Writes the cutters of the frame that spans the two times (s).
    void write_cutters(const graph::ResourcePool& pool, std::uint32_t slot, double frame_start, double frame_end) const;
    /// Writes the host inputs for simulating to `frame` (1 ..) into a slot.
    void write_inputs(const graph::ResourcePool& pool, std::uint32_t slot, std::uint32_t frame) const {
        write_inputs(pool, slot, frame, model_);
    }
    void write_inputs(const graph::ResourcePool& pool, std::uint32_t slot, std::uint32_t frame,
                      const SimulationModel& run) const;

    /// Per cloth, of the slot's last finished frame; its graph must have had `add_statistics`.
    std::vector<ClothStatistics> statistics(const graph::ResourcePool& pool, std::uint32_t slot) const {
        return statistics(pool, slot, model_);
    }
    std::vector<ClothStatistics> statistics(const graph::ResourcePool& pool, std::uint32_t slot,
                                            const SimulationModel& run) const;

    /// What contact between the cloths was in the slot's last simulated frame; where there is none, nothing.
    glsl::SelfRecord self_record(const graph::ResourcePool& pool, std::uint32_t slot) const;
    /// How full its fullest list came, 0 where there is none; above 1 the frame is no result.
    double self_list_use(const glsl::SelfRecord& record) const;
    /// Gives the lists of that frame room for more, from the next `declare` on; false: the device cannot.
    bool grow_lists(const glsl::SelfRecord& record);

    const SimulationModel& model() const { return model_; }
    std::size_t pipeline_count() const { return pipelines_.size(); }

  private:
    FieldContext context(std::size_t cloth, const FrameNeeds& needs = {}) const {
        return context(cloth, needs, model_);
    }
    FieldContext context(std::size_t cloth, const FrameNeeds& needs, const SimulationModel& run) const {
        return {run, run.cloths[cloth], topologies_[cloth], needs};
    }
    /// Cloths that are simulated together: fields that are images lie below each other in one image each, and are known
    /// here. A cloth's own handles to them are slices, and old until `take` renews them.
    struct Together {
        std::vector<std::size_t> cloths;
        ClothState state;
    };
    void declare_cloth(graph::Graph& graph, std::size_t index, const FrameNeeds& needs);
    void declare_together(graph::Graph& graph, Together& together, const FrameNeeds& needs);
    void declare_pins(graph::Graph& graph, Together& together, const FrameNeeds& needs);
    void upload_pins(const graph::ResourcePool& pool) const;
    void write_pins(const graph::ResourcePool& pool, std::uint32_t slot, const FrameInputs& inputs,
                    std::uint32_t substeps) const;
    ClothState state_of(std::size_t index) const;
    void find_together(const vulkan::Device& device);
    /// Gives a cloth the newest handles, and takes over those that it made.
    void take(std::size_t cloth);
    void give(std::size_t cloth);
    /// Among those that it is together with; 0 of one alone.
    std::uint32_t place_of(std::size_t cloth) const;
    /// Whatever is done for cloths together, and for each of the others.
    template <class Add>
    void for_each_dispatch(const Add& add);
    template <class Add>
    void for_each_cloth(const Add& add);
    glsl::StatisticsRecord statistics_record(const graph::ResourcePool& pool, std::uint32_t slot,
                                             std::size_t cloth) const;
    std::vector<Step> steps() const;
    /// `state` is null where contact is of all cloths at once.
    void add_step(graph::Graph& graph, ClothState* state, const Step& step);
    void declare_contact(graph::Graph& graph);
    ContactContext contact_context() const { return {*run_->self_contact, contact_.capacity}; }

    const SimulationModel& model_;
    const SimulationModel* run_;  ///< of the graph being built
    Kernels kernels_;
    std::vector<KernelVerdict> verdicts_;
    std::vector<CutTopology> topologies_;
    Pipelines pipelines_;
    /// Per cloth; the same in the graph of every kind of frame.
    std::vector<std::shared_ptr<std::vector<glsl::uvec4>>> iteration_sizes_;
    std::vector<ClothState> cloths_;
    std::vector<Together> together_;
    std::vector<std::size_t> together_of_;  ///< by cloth: index into `together_`, its size: none
    SceneInputs inputs_;
    std::uint64_t most_list_bytes_;
    ContactHandles contact_;
};

}  // namespace drape
