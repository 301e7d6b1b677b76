// The resources of the passes: a cloth's fields, the state of contact and the scene's host inputs as graph handles.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "cloth/cloth_state.h"
#include "cloth/contact_state.h"
#include "cloth/frame_inputs.h"
#include "cloth/state_sets.h"
#include "graph/executor.h"
#include "solver/pipelines.h"

namespace drape {

/// Bytes by the buffer that holds them.
using ClothConstants = std::map<std::string, std::vector<std::byte>>;

/// The newest handles of one cloth's resources within the graph being built.
struct ClothState {
    const ClothModel* model = nullptr;
    const CutTopology* topology = nullptr;
    /// With several this is the state of cloths that are simulated together: `model` is the first one's, and the
    /// handles are those of the images in which all lie below each other.
    std::vector<std::size_t> cloths;
    std::uint32_t count() const { return static_cast<std::uint32_t>(cloths.size()); }
    std::string name;
    /// Particles that pins hold, and pins that move or let go, of all those cloths.
    std::size_t pinned_count = 0, pin_count = 0;
    /// Invalid where the cloth does not need the field (cloth/cloth_state.h).
    graph::Handle& operator[](Field field) { return handles[static_cast<std::size_t>(field)]; }
    const graph::Handle& operator[](Field field) const { return handles[static_cast<std::size_t>(field)]; }
    std::array<graph::Handle, field_count> handles;
    bool buffered = false;          ///< passes store to the state's images through their buffer views
    bool away = false;              ///< the state is in the spare images, not where the frame starts
    std::uint32_t index_count = 0;  ///< of the triangles
    /// Field::iteration_sizes will hold these; the passes add them.
    std::shared_ptr<std::vector<glsl::uvec4>> iteration_sizes;
    bool unlike = false;  ///< the cloths differ in numbers of the scene
    /// Host inputs with constants of each cloth (solver/cloth_constants.h) will hold these; the passes add them.
    std::shared_ptr<ClothConstants> constants;
    std::map<std::string, graph::Handle> constant_buffers;
    /// Host input that says which of the cloths together take a step (shaders/include/present.h); invalid: all do.
    graph::Handle present;
    /// Host input of sizes of dispatches over them, of which the passes add the first two numbers.
    graph::Handle present_sizes;
    std::shared_ptr<std::vector<glsl::uvec4>> sizes_of_present;
    /// Whether spring shares and cells are images.
    bool masked() const { return topology->masked(); }
    /// Whether springs have lengths of their own at rest (shaders/include/rest_length.h).
    std::uint32_t own_rest() const { return model->rest_scales.empty() ? 0 : 1; }
    /// Makes the spare images the state, and the state's the spare ones.
    void turn();
    /// Makes the spare displacement the displacement.
    void turn_displacement();
    graph::PassName pass_name(const std::string& pass, const std::string& stage) const;
    graph::PassName step_name(const std::string& pass, const Step& step) const;
};

/// A field of the state and the field that a step writes its next value to when it cannot update it in place.
struct SpareField {
    Field field, spare;
};
inline constexpr SpareField spare_fields[] = {{Field::position, Field::position_spare},
                                              {Field::displacement, Field::displacement_spare},
                                              {Field::position_remainder, Field::position_remainder_spare},
                                              {Field::displacement_remainder, Field::displacement_remainder_spare}};

/// The newest handles of the state that contact between the cloths has (cloth/contact_state.h).
struct ContactHandles {
    graph::Handle& operator[](ContactField field) { return handles[static_cast<std::size_t>(field)]; }
    const graph::Handle& operator[](ContactField field) const { return handles[static_cast<std::size_t>(field)]; }
    std::array<graph::Handle, contact_field_count> handles;
    ContactCapacity capacity;  ///< entries that its lists have room for
    bool buffered = false;     ///< passes store to the sheet's images through their buffer views
};

inline constexpr const char* mesh_fields_name = "mesh fields";
inline constexpr const char* body_actions_name = "body actions";

/// The inputs of the whole scene.
struct SceneInputs {
    graph::Handle wind;         ///< a vec4 per substep, m/s
    graph::Handle stiffness;    ///< a factor per cloth; invalid where no stiffness changes
    graph::Handle colliders;    ///< ColliderRecords, sorted by kind
    graph::Handle mesh_fields;  ///< distances to meshes, as texels (shared/collider_types.h)
    /// Fields of meshes that deform are made from these (shared/form_types.h); invalid where none does.
    graph::Handle form_nodes, form_corners, form_guesses, form_sides;
    graph::Handle body_actions;  ///< a BodyAction per member and body; invalid where no action pushes bodies
    graph::Handle sewn_places;   ///< of all cloths: a SewnPlace each; passes write it
    graph::Handle gas_sums;      ///< of all cloths that close gas in: a GasSum per workgroup; passes write it
    graph::Handle openings;      ///< a SeamOpening per substep and time of closing; invalid where no seam closes
    graph::Handle attempt;       ///< closed loops: a SubstepChange per cloth
};

/// "<cloth>/<name>": the resource of a field; those of the state have one in every set.
std::string resource_name(const ClothModel& cloth, const FieldRow& row, StateSet set = StateSet::run);
/// The one of a state with this name (ClothState::name), which cloths that are simulated together have one of.
std::string resource_name(const std::string& state, const FieldRow& row, StateSet set = StateSet::run);
/// The resource of a field of contact.
std::string resource_name(const ContactRow& row, StateSet set);
/// Returns a name in every set, each once: what is not of the state has the same name in all.
template <class NameOf>
std::vector<std::string> names_in_sets(const NameOf& name_of) {
    std::vector<std::string> names;
    for (std::size_t set = 0; set < state_set_count; ++set)
        if (std::string name = name_of(static_cast<StateSet>(set)); names.empty() || name != names.front())
            names.push_back(std::move(name));
    return names;
}
/// Returns a resource's declaration as it is in another set.
graph::ImageDeclaration in_set(graph::ImageDeclaration image, StateSet set);
graph::BufferDeclaration in_set(graph::BufferDeclaration buffer, StateSet set);

}  // namespace drape
