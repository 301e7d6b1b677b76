// What every simulation pass shares: the cloth's images as graph handles, the scene's host inputs, and the
// pipelines of the device.
#pragma once

#include <array>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "cloth/cloth_state.h"
#include "cloth/frame_inputs.h"
#include "cloth/schedule.h"
#include "graph/executor.h"

namespace drape {

/// The device's compute pipelines, those asked for here counted, and what an invocation of theirs takes on it.
class Pipelines {
  public:
    explicit Pipelines(const vulkan::Device& device) : device_(device) {}
    const vulkan::ComputePipeline& get(const std::string& module,
                                       const std::vector<vulkan::SpecializationConstant>& constants = {});
    /// Different ones asked for.
    std::size_t size() const { return asked_for_.size(); }
    /// Entries of a list that an invocation takes in turn: on a CPU, where one costs as much to begin as some entries,
    /// several.
    std::uint32_t entries_each() const;
    /// Particles of a column that an invocation looks after in turn: several on a CPU, where a workgroup costs as much
    /// to begin as some particles, and what one lane of a subgroup does as much as if all did it. Fewer where each may
    /// take so many rounds of loops that the driver would end them silently (most_loop_rounds).
    std::uint32_t strip_rows(std::size_t rounds_each = 1) const;
    /// Of such a part, columns beside each other, where particles share what is costly.
    std::uint32_t strip_columns() const;
    /// So many parts of columns make up all rows.
    std::uint32_t strips_of(std::size_t rows) const;
    /// Likewise of particles counted row by row, of a pass that takes each for itself (shaders/include/strips.h).
    std::uint32_t strip_length() const;
    /// So many invocations, across and down, take all of a grid's particles in such parts.
    std::array<std::uint32_t, 2> over_strips(glsl::ivec2 grid) const;
    /// Likewise in parts of at most strip_rows() rows and strip_columns() columns (shaders/self_bent.comp).
    std::array<std::uint32_t, 2> over_parts(glsl::ivec2 grid) const;
    /// As the device's.
    bool wide_atomics() const;

  private:
    const vulkan::Device& device_;
    std::set<const vulkan::ComputePipeline*> asked_for_;
};

/// Why a cloth of this size cannot have its state written through buffer views (shaders/include/state_store.h); empty
/// when it can.
/// `count`: of so many cloths below each other.
std::string buffered_obstacle(const vulkan::Device& device, const Grid& grid, std::uint32_t count = 1);
/// Likewise of the sheet on which cloths meet.
std::string sheet_obstacle(const vulkan::Device& device, glsl::ivec2 size);
/// Likewise why a cloth's micro-steps cannot stream.
std::string streamed_obstacle(const vulkan::Device& device, const Grid& grid);

/// Likewise why no workgroup can hold a tile of a cloth or its longest line.
std::string large_group_obstacle(const vulkan::Device& device);

/// Invocations: those of the strips that a grid of so many columns takes, where each subgroup has `width` columns of
/// which `halo` at either end are of no use.
std::uint32_t stream_invocations(int columns, int width, int halo);

/// Bands of rows that each strip is streamed in (shaders/include/row_bands.h).
std::uint32_t stream_bands(int rows);

/// Newest handles of one cloth's resources within the graph being built.
struct ClothState {
    const ClothModel* model = nullptr;
    const CutTopology* topology = nullptr;
    std::size_t index = 0;
    /// Of several cloths that are simulated together: the first is `model`; the handles are those of the images that
    /// they lie in below each other.
    std::uint32_t count = 1;
    std::string name;
    /// Of all of them: particles that pins hold, and pins, that move or let go.
    std::size_t pinned_count = 0, pin_count = 0;
    /// Invalid where the cloth does not need the field (cloth/cloth_state.h).
    graph::Handle& operator[](Field field) { return handles[static_cast<std::size_t>(field)]; }
    const graph::Handle& operator[](Field field) const { return handles[static_cast<std::size_t>(field)]; }
    std::array<graph::Handle, field_count> handles;
    bool buffered = false;          ///< passes write the state's images through their buffer views
    bool away = false;              ///< the state is in the spare images, not where the frame starts
    std::uint32_t index_count = 0;  ///< of the triangles
    /// What Field::iteration_sizes will hold, gathered while the passes are added.
    std::shared_ptr<std::vector<glsl::uvec4>> iteration_sizes;
    /// Whether spring shares and cells are images.
    bool masked() const { return topology->masked(); }
    /// What a micro-step wrote becomes the state.
    void turn();
    /// What a prediction or a sweep wrote becomes the displacement.
    void turn_displacement();
    graph::PassName pass_name(const std::string& pass, const std::string& stage) const;
    graph::PassName step_name(const std::string& pass, const Step& step) const;
};

/// What a micro-step reads, and the field that it writes the next of.
struct SpareField {
    Field field, spare;
    const char* variable;  ///< of the shaders, with _in and _out
};
inline constexpr SpareField spare_fields[] = {
    {Field::position, Field::position_spare, "position"},
    {Field::displacement, Field::displacement_spare, "displacement"},
    {Field::position_remainder, Field::position_remainder_spare, "position_remainder"},
    {Field::displacement_remainder, Field::displacement_remainder_spare, "displacement_remainder"}};

/// "<cloth>/<name>": a field's resource.
std::string resource_name(const ClothModel& cloth, const FieldRow& row);

/// Host inputs of the whole scene.
struct SceneInputs {
    graph::Handle wind;
    graph::Handle colliders;  ///< ColliderRecords, sorted by kind
    graph::Handle attempt;    ///< closed loops: a StepChange per cloth
};

/// What the shaders that meet colliders (include/colliders.h) are specialised with: where each kind ends in the list.
std::vector<vulkan::SpecializationConstant> collider_constants(const SceneDescription& scene);

/// Declares read then write of one resource and stores the new handle: by two variables of the shader, NAME_in and
/// NAME_out, so that synchronization validation sees them apart, or by one.
void update(graph::PassSetup& setup, graph::Handle& handle, const std::string& name);
/// Declares that the state is read and its spare images are written, all of them.
void write_spare(graph::PassSetup& setup, ClothState& state);
/// Declares what a prediction does with the displacement: it updates it, or, where the step turns, reads it and writes
/// the spare one.
void write_prediction(graph::PassSetup& setup, ClothState& state, const Step& step);
void update_in_place(graph::PassSetup& setup, graph::Handle& handle, const std::string& name);

}  // namespace drape
