// What every simulation pass shares: the cloth's images as graph handles, the scene's host inputs, and the
// pipelines made so far.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cloth/cut_topology.h"
#include "cloth/frame_inputs.h"
#include "cloth/schedule.h"
#include "graph/executor.h"

namespace drape {

/// Compute pipelines by module and constants, made when first asked for.
class PipelineCache {
  public:
    explicit PipelineCache(const vulkan::Device& device) : device_(device) {}
    const vulkan::ComputePipeline& get(const std::string& module,
                                       const std::vector<vulkan::SpecializationConstant>& constants = {});
    std::size_t size() const { return pipelines_.size(); }

  private:
    const vulkan::Device& device_;
    std::map<std::string, std::unique_ptr<vulkan::ComputePipeline>> pipelines_;
};

/// Newest handles of one cloth's resources within the graph being built. Images have one texel per particle.
///   position       rgba32f  xyz: position at the start of the substep, m; at a frame's end the state itself.
///                           w: relative inverse mass; written by the set-up and by `pin release` alone
///   displacement   rgba32f  xyz: motion within the substep, m (X + d is where the particle is now); w 0
///   *_rest         rgba32f  what rounding lost of the two (compensated sums)
///   *_spare        rgba32f  explicit: the other image of each pair; a micro-step reads one and writes the other
///   wind_force     rgba32f  N; scenes with wind
///   normal         rgba32f  unit normal of the front; only when something is drawn
///   tension        r32f     per direction, by first particle, m: extension that would balance the tension applied in
///   the
///                           substep; compliant and iterated springs, and stretch where the stretch error is wanted
///   residuals      buffer   stretch error by workgroup; where iterations end by tolerance
///   iterations     buffer   sizes of the next iteration's dispatches, and iterations run (residual_types.h); likewise
///   displacement_before     rgba32f  line in second order: displacement of the substep before the last, m
///   velocity_excess         rgba32f  line in second order: of that substep, h times its end's velocity - displacement,
///   m line_control   r32ui    line in second order: LineControl (shaders/include/bdf2.h), an integer per texel
///   line_scratch   vec2[]   line: eliminated rows, within a pass
///   stiffness      rgba32f  share per direction, by first particle; holes and cuts
///   mass           r32f     mass share (1 = an inner particle's); holes and cuts, where statistics are wanted
///   cells          r32ui    triangles that exist, one texel per cell; holes and cuts
struct ClothState {
    const ClothModel* model = nullptr;
    const CutTopology* topology = nullptr;
    std::size_t index = 0;
    graph::Handle position, displacement, position_rest, displacement_rest;
    graph::Handle position_spare, displacement_spare;
    bool away = false;  ///< explicit: position and displacement are the spare images, not where the frame starts
    graph::Handle wind_force, normal, stiffness, mass, cells;
    std::array<graph::Handle, 4> tension;
    graph::Handle residuals, iterations, iteration_size_list;
    /// What the list will hold, gathered while the passes are added.
    std::shared_ptr<std::vector<glsl::uvec4>> iteration_sizes;
    graph::Handle line_scratch, displacement_before, velocity_excess, line_control;
    graph::Handle triangles;     ///< index buffer
    graph::Handle cut_vertices;  ///< vertices on cut springs; cut cloths that are drawn
    std::uint32_t index_count = 0;
    graph::Handle pinned, pin_motions;  ///< dynamic pins
    graph::Handle tethers;              ///< ParticleTethers of every particle
    /// Whether stiffness and cells are images.
    bool masked() const { return topology->masked(); }
    /// What a micro-step wrote becomes the state.
    void turn();
    graph::PassName pass_name(const std::string& pass, const std::string& stage) const;
    graph::PassName step_name(const std::string& pass, const Step& step) const;
};

/// Host inputs of the whole scene.
struct SceneInputs {
    graph::Handle wind;
    std::array<graph::Handle, collider_kind_count> colliders;  ///< invalid where the scene has none of the kind
};

/// By kind: the constants of the shaders that meet colliders, which say whether the scene has any of the kind.
inline constexpr std::array<std::string_view, collider_kind_count> collider_constants = {"has_planes", "has_spheres",
                                                                                         "has_boxes", "has_ellipsoids"};
/// "spheres" and so on: the shaders' array, and after "colliders/" the buffer's name.
std::string_view collider_kind_name(std::size_t kind);
/// Declares that a compute pass reads the colliders. A kind that the scene lacks borrows another kind's buffer: its
/// count is 0, so nothing is read.
void read_colliders(graph::PassSetup& setup, const SceneInputs& inputs);

/// Declares read then write of one resource and stores the new handle: by two variables of the shader, NAME_in and
/// NAME_out, so that synchronization validation sees them apart, or by one.
void update(graph::PassSetup& setup, graph::Handle& handle, const std::string& name);
void update_in_place(graph::PassSetup& setup, graph::Handle& handle, const std::string& name);

}  // namespace drape
