// Contact of cloths with themselves and each other: the passes that end a substep (shaders/include/self_contact.h).
// `contact`: the state of the scene's first cloth, with which what they share is kept.
#pragma once

#include "solver/pass_kit.h"

namespace drape {

/// Lays a cloth's particles on the sheet: reads its position, displacement, [existing triangles].
void add_self_gather(graph::Graph& graph, Pipelines& pipelines, const ClothState& cloth, ClothState& contact,
                     const Step& step);
/// Likewise those that colliders have moved since then: reads its displacement; updates that on the sheet.
void add_self_gather_again(graph::Graph& graph, Pipelines& pipelines, const ClothState& cloth, ClothState& contact,
                           const Step& step);
/// Moves those that contact moved since then: reads what lies on the sheet; updates the cloth's displacement,
/// [displacement before, line control].
void add_self_return(graph::Graph& graph, Pipelines& pipelines, ClothState& cloth, ClothState& contact,
                     const Step& step);

// The rest know the sheet alone: by position and displacement they mean those on it.

/// Reads displacement; begins the record anew.
void add_self_common(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step);
/// Reads position, displacement, record, kept boxes; writes boxes, begins the sums and shares anew, writes the
/// displacement before contact; says whether candidates are searched.
void add_self_boxes(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step);
// From here on most run as far as the passes before said that there is something to do (Field::self_sizes).
/// Begins a search: counts in the record anew.
void add_self_search(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step);
/// Reads boxes, displacement, record; writes the lowest level of kept boxes.
void add_self_kept(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step);
/// Updates kept boxes: levels from the levels below.
void add_self_levels(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step);
/// Reads kept boxes; writes the list of cells, for now with blocks of them, counts them in the record.
void add_self_blocks(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step);
/// Reads kept boxes and that list; writes the candidates, counts them in the record.
void add_self_cells(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step);
/// Reads boxes, candidates; writes the list of cells, counts them in the record.
void add_self_near(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step);
/// Reads position, displacement; adds neighbouring cells to that list, counts them in the record.
/// `largest`: columns and rows that no cloth has more of.
void add_self_bent(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, glsl::ivec2 largest,
                   const Step& step);
// Of cloths that started through each other (shaders/include/self_apart.h):
/// Reads position, displacement, cells; counts in the crossings.
void add_self_crossings(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step);
/// Reads crossings; writes what cloths are led by, counts crossings in the record.
void add_self_apart(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step);
/// Reads position, displacement, cells, [crossings]; writes the list of primitives near each other, counts them in the
/// record.
void add_self_primitives(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step);
/// Reads position, displacement, the two lists; writes the list of pairs, counts them in the record.
void add_self_pairs(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step);
/// Reads position, displacement, pairs; adds to the corrections.
void add_self_contact(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step);
/// Reads position, displacement before contact; takes the corrections; updates displacement.
void add_self_push(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step);
/// Reads position, displacement, displacement before contact, pairs; lowers the round's shares.
void add_self_room(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step);
/// Reads position, displacement before contact, shares; updates displacement, the record.
void add_self_move(graph::Graph& graph, Pipelines& pipelines, ClothState& contact, const Step& step);

/// Copies the frame's record to the host.
void add_self_readback(graph::Graph& graph, const ClothState& contact);
inline constexpr const char* self_readback_name = "self record on the host";

}  // namespace drape
