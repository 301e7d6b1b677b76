// The steps of every frame of a scene as passes of a graph, and the state that they work on.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "cloth/cloth_statistics.h"
#include "cloth/cut_topology.h"
#include "cloth/difference.h"
#include "solver/attempt_pass.h"
#include "solver/kernel_choice.h"
#include "solver/pass_kit.h"

namespace drape {

/// The bytes that the host had put into a cloth's fields before a cut, by field.
struct CutImages {
    std::array<std::vector<std::byte>, field_count> fields;
    std::size_t index_count, vertex_count;  ///< those of the triangles that were drawn
};

/// The state of a cloth, by field.
using ClothBytes = std::map<std::string, std::vector<std::byte>>;
/// Returns one of them; nothing where it is not there.
std::vector<std::byte> field_of(const ClothBytes& state, Field field);

/// Returns whether a cut leaves so much to draw that it needs other buffers.
bool draws_outgrown(const CutImages& before, const CutTopology& topology);

class ClothSolver {
  public:
    /// Makes no pipeline yet; the functions that add passes make those that the graph needs. Throws VulkanError when
    /// the device has not what a kernel that is asked for needs.
    /// `in_part`: passes are taken for those cloths that `write_present` names; then all must lie together.
    ClothSolver(const vulkan::Device& device, const SimulationModel& model,
                const Kernels& kernels = Kernels::automatic(), bool in_part = false);
    /// Returns whether every cloth is simulated together with another.
    bool all_together() const;
    /// The kernels that its steps may use.
    const Kernels& kernels() const { return kernels_; }

    /// The topology that cuts have left of each cloth. A change acts from the next `declare` or `upload_cut` on.
    std::vector<CutTopology>& topologies() { return topologies_; }
    const std::vector<CutTopology>& topologies() const { return topologies_; }
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
    /// Returns the cloths that a step is taken for.
    std::vector<std::size_t> cloths_of(const Step& step) const;
    /// Adds passes that take every cloth's positions from the host (solver/position_upload.h).
    void add_positions(graph::Graph& graph);
    /// Adds the normals of every cloth (the graph drops them when nothing reads them).
    void add_normals(graph::Graph& graph);
    /// Adds copies to the host of an image of four floats per particle, every cloth's `what`, to be read by `readback`.
    void add_readback(graph::Graph& graph, Field image, std::string_view what);
    /// Adds the statistics of every cloth (solver/statistics_pass.h), to be read by `statistics`.
    void add_statistics(graph::Graph& graph);
    /// Adds a pass that a closed loop needs around the attempts at a frame (solver/attempt_pass.h).
    void add_attempt(graph::Graph& graph, StateStep step);
    /// Returns what the slot's last frame read back of each cloth, particle by particle.
    std::vector<std::span<const float>> readback(const graph::ResourcePool& pool, std::uint32_t slot,
                                                 std::string_view what) const;
    /// Returns how far the slot's last comparison found each cloth from the coarse run, m.
    std::vector<double> differences(const graph::ResourcePool& pool, std::uint32_t slot) const;
    /// Adds the search for springs and triangles that the cutters cross.
    void add_cuts(graph::Graph& graph);
    /// Adds the search for springs that bear too much.
    void add_tears(graph::Graph& graph);
    /// The newest handles since `declare`.
    const std::vector<ClothState>& cloths() const { return cloths_; }

    /// Uploads the initial state, masks, triangles and pins to whatever of them the pool holds.
    void upload(const graph::ResourcePool& pool) const;
    /// Fetches the state of all cloths, by resource, so that it can be carried over to new resources.
    /// In every set that the pool has.
    std::map<std::string, std::vector<std::byte>> download_state(const graph::ResourcePool& pool) const;
    void upload_state(const graph::ResourcePool& pool,
                      const std::map<std::string, std::vector<std::byte>>& state) const;
    /// Fetches the state of some cloths.
    std::vector<ClothBytes> download_cloths(const graph::ResourcePool& pool, std::span<const std::size_t> cloths,
                                            StateSet set = StateSet::run) const;
    /// Uploads the state of some cloths and leaves the others as they are; null: as the cloth starts. Throws
    /// std::invalid_argument where one is not of such a cloth, before anything is uploaded.
    void upload_cloths(const graph::ResourcePool& pool, const std::map<std::size_t, const ClothBytes*>& states,
                       StateSet set = StateSet::run) const;
    /// Fetches what pairs bore, by member, as a run of each of them has it (cloth/contact_state.h).
    std::vector<std::vector<std::byte>> download_borne(const graph::ResourcePool& pool) const;
    /// Uploads it. Returns false, and uploads nothing, where the list has no room for it until the next `declare`.
    bool upload_borne(const graph::ResourcePool& pool, const std::vector<std::vector<std::byte>>& states);
    /// Returns what a field of a cloth starts with; nothing: with zeros.
    std::vector<std::byte> start_of_field(std::size_t cloth, Field field) const;
    /// Uploads the parts of a cut cloth's fields that differ from `before`.
    void upload_cut(const graph::ResourcePool& pool, std::size_t cloth, const CutImages& before) const;
    /// Copies the host's side of a cloth's fields, for `upload_cut` to compare with.
    CutImages cut_images(std::size_t cloth) const;
    /// Writes the cutters of the frame that spans the two times (s).
    void write_cutters(const graph::ResourcePool& pool, std::uint32_t slot, double frame_start, double frame_end) const;
    /// Writes the host inputs for simulating to `frame` (1 ..) into a slot.
    void write_inputs(const graph::ResourcePool& pool, std::uint32_t slot, std::uint32_t frame) const {
        write_inputs(pool, slot, frame, model_);
    }
    void write_inputs(const graph::ResourcePool& pool, std::uint32_t slot, std::uint32_t frame,
                      const SimulationModel& run) const;
    /// Writes these, but for the constants of cloths together.
    void write_inputs(const graph::ResourcePool& pool, std::uint32_t slot, const FrameInputs& inputs,
                      std::uint32_t substeps) const;
    /// Writes the constants that each of the cloths together has its own of, which frames leave as they are.
    void write_constants(const graph::ResourcePool& pool, std::uint32_t slot, std::uint32_t substeps) const;

    /// Writes for which cloths the passes of the next submit are taken.
    void write_present(const graph::ResourcePool& pool, std::uint32_t slot, const std::vector<bool>& cloths) const;

    /// Writes how an attempt changes the length of each cloth's substeps.
    void write_changes(const graph::ResourcePool& pool, std::uint32_t slot,
                       const std::vector<glsl::SubstepChange>& changes) const;

    /// Returns each cloth's statistics of the slot's last finished frame, which is `frame`, and whose graph must have
    /// had `add_statistics`.
    std::vector<ClothStatistics> statistics(const graph::ResourcePool& pool, std::uint32_t slot,
                                            std::uint32_t frame) const {
        return statistics(pool, slot, frame, model_);
    }
    std::vector<ClothStatistics> statistics(const graph::ResourcePool& pool, std::uint32_t slot, std::uint32_t frame,
                                            const SimulationModel& run) const;

    /// Returns the record of contact between the cloths in the slot's last simulated frame, zeros where there is none.
    /// Where cloths of several members lie on the sheet, the first one's has the counts of all lists.
    glsl::SelfRecord self_record(const graph::ResourcePool& pool, std::uint32_t slot) const;
    /// Returns what a member's record would be if it were alone, but for lists that are no pairs.
    glsl::SelfRecord self_record_of(const graph::ResourcePool& pool, std::uint32_t slot, std::size_t member) const;
    /// Returns whether saved bytes can take the place of a part of the state as it is now; a list has room for them
    /// from the next `declare` on.
    bool takes(const std::string& name, std::span<const std::byte> now, std::span<const std::byte> saved);
    /// Returns how full the fullest of contact's lists was, 0 where there is none; above 1 the frame is no result.
    double self_list_use(const glsl::SelfRecord& record) const;
    /// Lengthens the lists that were too short for that frame, from the next `declare` on; false: the device cannot.
    bool grow_lists(const glsl::SelfRecord& record);

    const SimulationModel& model() const { return model_; }
    std::size_t pipeline_count() const { return pipelines_.size(); }

    /// Returns the bytes of each cloth's statistics, where the slot's last finished frame has left them.
    std::vector<std::span<const std::byte>> statistics_records(const graph::ResourcePool& pool,
                                                               std::uint32_t slot) const;

  private:
    FieldContext context(std::size_t cloth, const FrameNeeds& needs = {}) const {
        return context(cloth, needs, model_);
    }
    FieldContext context(std::size_t cloth, const FrameNeeds& needs, const SimulationModel& run) const {
        return {run, run.cloths[cloth], topologies_[cloth], needs};
    }
    /// Cloths that are simulated together. Their images of a field lie below each other in one image, whose handle is
    /// here. A cloth's own handles to it are slices, and old until `take` renews them.
    struct Together {
        std::vector<std::size_t> cloths;
        bool unlike;
        ClothState state;
        std::map<std::uint32_t, std::shared_ptr<ClothConstants>> constants;  ///< by substeps per frame
        std::shared_ptr<std::vector<glsl::uvec4>> sizes_of_present;          ///< of all graphs' passes
    };
    void declare_cloth(graph::Graph& graph, std::size_t index, const FrameNeeds& needs);
    void declare_together(graph::Graph& graph, Together& together, const FrameNeeds& needs);
    /// Declares what says which of them are present (cloths_together.cpp).
    void declare_present(graph::Graph& graph, Together& together) const;
    /// Declares the lists of cloths together, joined (cloths_together.cpp).
    void declare_lists(graph::Graph& graph, Together& together, const FrameNeeds& needs);
    void upload_together(const graph::ResourcePool& pool) const;
    /// Returns what a field of cloths together starts with, cloth by cloth.
    std::vector<std::byte> start_of(const Together& together, const FieldRow& row) const;
    /// Writes the pins of cloths together.
    void write_together(const graph::ResourcePool& pool, std::uint32_t slot, const FrameInputs& inputs,
                        std::uint32_t substeps) const;
    ClothState state_of(std::size_t index) const;
    void find_together(const vulkan::Device& device);
    /// Gives a cloth the newest handles of the images that it shares.
    void take(std::size_t cloth);
    /// Makes the handles that a cloth made those of the images that it shares.
    void give(std::size_t cloth);
    bool is_alone(std::size_t cloth) const { return together_of_[cloth] == together_.size(); }
    /// Returns the name of the state that a cloth's is a part of.
    const std::string& state_name(std::size_t cloth) const;
    /// Returns a cloth's part of what a pass over its state left on the host.
    std::span<const std::byte> part_of(std::size_t cloth, const vulkan::Buffer& of_state) const;
    /// Calls `visit` with each image of the pool that is of the state, its row and the cloths that lie in it.
    template <class Visit>
    void for_state_images(const graph::ResourcePool& pool, const Visit& visit) const;
    /// Calls `add` once for cloths together, and for each of the others.
    template <class Add>
    void for_each_dispatch(const Add& add);
    template <class Add>
    void for_each_cloth(const Add& add);
    /// Adds the tension that steps of a method do not keep, for the statistics.
    void add_tension(graph::Graph& graph, ClothState& state);
    void add_dispatches(graph::Graph& graph, const Step& step);
    /// `state` is null where contact is of all cloths at once.
    void add_step(graph::Graph& graph, ClothState* state, const Step& step);
    void declare_contact(graph::Graph& graph);
    ContactContext contact_context() const { return {*run_->self_contact, contact_.capacity}; }

    const SimulationModel& model_;
    const SimulationModel* run_;    ///< the run of the graph that is being built
    StateSet set_ = StateSet::run;  ///< the set that it works on
    bool in_part_;
    Kernels kernels_;
    std::vector<KernelVerdict> verdicts_;
    std::vector<CutTopology> topologies_;
    Pipelines pipelines_;
    /// The sizes that iterations of each cloth choose from, which the graphs of all kinds of frames share.
    std::vector<std::shared_ptr<std::vector<glsl::uvec4>>> iteration_sizes_;
    std::vector<ClothState> cloths_;
    std::vector<Together> together_;
    std::vector<std::size_t> together_of_;  ///< index into `together_` by cloth; the size of that: alone
    std::vector<std::uint32_t> place_of_;   ///< a cloth's place among those that it is together with
    SceneInputs inputs_;
    std::uint64_t most_list_bytes_;
    ContactHandles contact_;
};

}  // namespace drape
