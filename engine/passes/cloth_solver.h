// The method `relax`, the slides' own: strings the simulation passes of every cloth together by the schedule.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cloth/cloth_statistics.h"
#include "passes/pass_kit.h"

namespace drape {

class ClothSolver {
  public:
    /// Makes no pipeline yet: `add_*` makes what the graph needs.
    ClothSolver(const vulkan::Device& device, const SimulationModel& model);

    /// Declares the images and host inputs that the scene needs, and only those. `drawn`: also what drawing
    /// needs (triangles, normals).
    void declare(graph::Graph& graph, bool drawn);
    /// Adds the passes of one frame.
    void add_simulation(graph::Graph& graph);
    /// Adds the normals of every cloth (the graph drops them when nothing reads them).
    void add_normals(graph::Graph& graph);
    /// Adds the statistics of every cloth (passes/statistics_pass.h), to be read by `statistics`.
    void add_statistics(graph::Graph& graph);
    /// The newest handles since `declare`.
    const std::vector<ClothState>& cloths() const { return cloths_; }

    /// Uploads the initial state, masks, triangles and pins to whatever of them the pool holds.
    void upload(const graph::ResourcePool& pool) const;
    /// Writes the host inputs for simulating to `frame` (1 ..) into a slot.
    void write_inputs(const graph::ResourcePool& pool, std::uint32_t slot, std::uint32_t frame) const;

    /// Per cloth, of the slot's last finished frame; its graph must have had `add_statistics`.
    std::vector<ClothStatistics> statistics(const graph::ResourcePool& pool, std::uint32_t slot) const;

    const SimulationModel& model() const { return model_; }
    std::size_t pipeline_count() const { return pipelines_.size(); }

  private:
    void declare_cloth(graph::Graph& graph, const ClothModel& model, std::size_t index, bool drawn);
    void add_step(graph::Graph& graph, ClothState& state, const Step& step);

    const SimulationModel& model_;
    PipelineCache pipelines_;
    std::vector<ClothState> cloths_;
    SceneInputs inputs_;
};

/// "spheres" and so on: the collider buffer's name is "colliders/" + this.
std::string_view collider_kind_name(std::size_t kind);

}  // namespace drape
