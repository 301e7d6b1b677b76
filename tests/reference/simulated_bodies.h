// A scene that is simulated by the twin and tells what its bodies do.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "base/vectors.h"
#include "cloth/bodies.h"
#include "simulated.h"

namespace drape::test {

inline Collider ball(const Vec3& center, double radius, double mass) {
    Collider body{Sphere{center, radius}};
    body.mass = mass;
    return body;
}

/// A run of the twin, and its bodies.
class Bodies : public Simulated {
  public:
    using Simulated::Simulated;
    void frames(std::uint32_t count) {
        frame_ += count;
        Simulated::frames(count);
    }
    BodyState body(std::size_t k = 0) const {
        const std::vector<glsl::vec4>& state = twin().cloth(0)[Field::bodies];
        return body_states(model(), std::span(&state[0].x, 4 * state.size()), frame_).at(k);
    }

  private:
    std::uint32_t frame_ = 0;
};

/// The momentum of one of a run's cloths and its angular momentum about the origin.
inline std::pair<Vec3, Vec3> momenta(const Bodies& run, std::size_t index = 0) {
    const TwinCloth& state = run.twin().cloth(index);
    const ClothModel& cloth = run.model().cloths[index];
    const std::vector<float> shares = mass_shares(cloth);
    std::pair<Vec3, Vec3> sums{};
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const auto vector = [&](Field field) {
            const glsl::vec4& at = state[field][i];
            return Vec3{double{at.x}, double{at.y}, double{at.z}};
        };
        const Vec3 own = times(cloth.inner_mass * double{shares[i]} / cloth.substep_length,
                               plus(vector(Field::displacement), vector(Field::end_excess)));
        sums.first = plus(sums.first, own);
        sums.second = plus(sums.second, cross(vector(Field::position), own));
    }
    return sums;
}

}  // namespace drape::test
