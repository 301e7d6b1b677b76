// Devices make the field of a mesh that deforms from these lists, one set for each form (shared/form_types.h).
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/distance_field.h"
#include "shared/form_types.h"

namespace drape {

struct FormLists {
    std::vector<glsl::FormNode> nodes;
    std::vector<glsl::vec4> corners;     ///< m, in the mesh's frame: three for each triangle
    std::vector<std::uint32_t> guesses;  ///< by block of samples: the triangle nearest to its middle
    std::vector<std::uint32_t> sides;    ///< a bit for every sample, from the lowest on: 1 inside

    void append(const FormLists& other);
};

/// Returns the lists of a form. `field`: the field to be computed, without its samples; its distances are exact within
/// `exact` of the surface, m.
FormLists form_lists(const MeshShape& form, const DistanceField& field, double exact);

}  // namespace drape
