// Loads that tests give to cloths.
#pragma once

#include <utility>
#include <vector>

#include "drape/scene.h"

namespace drape::test {

inline Load pull(const IndexBox& particles, const Vec3& force) {
    Load load;
    load.particles = particles;
    load.force = force;
    return load;
}
inline Load pull(const IndexBox& particles, std::vector<VectorKey> keys) {
    Load load;
    load.particles = particles;
    load.force_keys = std::move(keys);
    return load;
}
inline Load press(const IndexBox& particles, double pressure) {
    Load load;
    load.particles = particles;
    load.pressure = pressure;
    return load;
}

}  // namespace drape::test
