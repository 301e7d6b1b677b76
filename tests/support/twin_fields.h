// A run is compared with the twin's field by field.
#pragma once

#include <cstddef>

#include "cloth/cloth_state.h"
#include "twin/twin.h"

namespace drape::test {

/// Calls `visit(cloth, row, bytes)` for the state that the twin keeps of each cloth, and for its normals.
template <class Visit>
void for_compared_fields(const SimulationModel& model, Twin& twin, Visit visit,
                         const FrameNeeds& needs = {.drawing = true}) {
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth) twin.normals(cloth);
    twin.sew_normals();
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth) {
        const TwinCloth& expected = twin.cloth(cloth);
        const FieldContext about{model, model.cloths[cloth], expected.topology, needs};
        for (const FieldRow& row : cloth_fields())
            if (row.needed(about) && (row.life == FieldLife::state || row.field == Field::normal))
                visit(cloth, row, expected.bytes(row.field));
    }
}

}  // namespace drape::test
