// The twin sums a cloth's impulses, as shaders/include/book_impulses.h does.
#pragma once

#include <array>

#include "twin/kernels.h"
#include "twin/twin.h"

namespace drape {

class TwinImpulses {
  public:
    explicit TwinImpulses(TwinCloth& state) : impulses_(state.integers(Field::impulses)) {}

    /// Returns whether the scene wants forces.
    bool are_wanted() const { return !impulses_.empty(); }
    float units() const { return glsl::uintBitsToFloat(impulses_[glsl::impulse_head]); }
    /// Adds a part of which each unit counts to three numbers of a row, from the `first` on.
    void add(int row, int first, glsl::vec3 part, float units) {
        const glsl::ImpulseSum sum = glsl::with_impulse(glsl::no_impulse(), part, units);
        const std::array<glsl::ImpulseWords, 3> words{words_of(sum.x), words_of(sum.y), words_of(sum.z)};
        for (int k = 0; k < 3; ++k) {
            const auto place = static_cast<std::size_t>(row * glsl::impulse_columns + 2 * (first + k));
            const glsl::ImpulseWords whole =
                glsl::words_sum({impulses_[place], impulses_[place + 1]}, words[static_cast<std::size_t>(k)]);
            impulses_[place] = whole.low;
            impulses_[place + 1] = whole.high;
        }
    }

  private:
    std::vector<glsl::uint>& impulses_;
};

/// What colliders give to the motion of a particle, as in shaders/collision.comp.
class TwinGivers {
  public:
    void take(int number, glsl::vec3 given) {
        by_all_ = glsl::moved_position(by_all_, given);
        for (std::size_t k = 0; k < most; ++k) {
            if (numbers_[k] != number && numbers_[k] >= 0 && k + 1 < most) continue;
            if (numbers_[k] < 0) numbers_[k] = number;
            motions_[k] = glsl::moved_position(motions_[k], given);
            return;
        }
    }
    void book(TwinImpulses& impulses, const glsl::ColliderRecord* colliders, glsl::vec4 start,
              glsl::vec3 displacement) const {
        const float mass = glsl::reciprocal(start.w);
        for (std::size_t k = 0; k < most; ++k) {
            if (numbers_[k] < 0) continue;
            const glsl::ColliderRecord& by = colliders[numbers_[k]];
            const int row = glsl::impulse_first + numbers_[k];
            impulses.add(row, 0, glsl::impulse_of_motion(motions_[k], mass), impulses.units());
            impulses.add(
                row, 3,
                glsl::impulse_of_motion(glsl::moment_about({start.x, start.y, start.z}, displacement,
                                                           {by.pose_x.w, by.pose_y.w, by.pose_z.w}, motions_[k]),
                                        mass),
                impulses.units());
        }
    }

    /// Adds what all of them gave to a particle to what they gave it in the frame.
    void keep(glsl::vec4& kept, float inverse_mass) const {
        const glsl::vec3 given = glsl::impulse_of_motion(by_all_, glsl::reciprocal(inverse_mass));
        const glsl::vec3 sum = glsl::moved_position({kept.x, kept.y, kept.z}, given);
        kept = {sum.x, sum.y, sum.z, 0};
    }

  private:
    static constexpr std::size_t most = 3;
    std::array<int, most> numbers_{-1, -1, -1};
    std::array<glsl::vec3, most> motions_{};
    glsl::vec3 by_all_{};
};

}  // namespace drape
