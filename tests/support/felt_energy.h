// The elastic energy of a sheet's shape, as a solver feels it.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "support/sheet_state.h"
#include "twin/twin.h"

namespace drape::test {

/// Energy (J) of a shape as one substep from rest feels it: its forces are F = m d/h^2 and grow in proportion to the
/// displacement u from the shape `rest` without them, so E = -1/2 sum u . F.
inline double felt_energy(const SceneDescription& scene, const std::vector<Vec3>& shape,
                          const std::vector<Vec3>& rest) {
    const SimulationModel model(scene);
    EXPECT_TRUE(model.cloths[0].scheme.compromises.empty());
    Twin twin(model);
    TwinCloth& state = twin.cloth(0);
    for (std::size_t i = 0; i < shape.size(); ++i) {
        glsl::vec4& x = state[Field::position][i];
        x = {static_cast<float>(shape[i][0]), static_cast<float>(shape[i][1]), static_cast<float>(shape[i][2]), x.w};
    }
    twin.run_frame(1);
    const double h = model.cloths[0].substep_length;
    double energy = 0;
    for (std::size_t i = 0; i < shape.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            energy -=
                0.5 / (h * h) * (shape[i][k] - rest[i][k]) * mass_of(model.cloths[0], i) * displacement_of(state, i)[k];
    return energy;
}

}  // namespace drape::test
