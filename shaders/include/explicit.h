// The explicit micro-step, in which every particle gathers the forces of the springs around it: symplectic Euler with
// clamped stiffness and strain-rate damping (docs/solvers.md, "Explicit micro-step").
#ifndef DRAPE_EXPLICIT_H
#define DRAPE_EXPLICIT_H

#include "include/spring.h"

const int neighbour_count = 8;

/// Returns neighbour k in the order of every sum over springs: up-left, up, up-right, left, right, down-left, down,
/// down-right (rows grow downwards). xy: offset in columns, rows; z: direction of the spring (channel); w: 1 if this
/// particle is the spring's first one, 0 if the neighbour is.
SHARED ivec4 neighbour(int k) {
    if (k == 0) return ivec4(-1, -1, 2, 0);
    if (k == 1) return ivec4(0, -1, 1, 0);
    if (k == 2) return ivec4(1, -1, 3, 0);
    if (k == 3) return ivec4(-1, 0, 0, 0);
    if (k == 4) return ivec4(1, 0, 0, 1);
    if (k == 5) return ivec4(-1, 1, 3, 1);
    if (k == 6) return ivec4(0, 1, 1, 1);
    return ivec4(1, 1, 2, 1);
}

/// Springs are damped where they are stretched by more than this share of their length, as in a tangle, which would
/// otherwise gain energy. In ordinary fabric only a small share of the damping remains: it removes the energy that
/// rounding adds to the shortest waves, and changes the motion by less than the length of a step does.
const float damped_strain = 0.1f, calm_share = 0.05f;

/// Returns kappa of a spring that is longer than its rest length by `excess` (m).
SHARED float damping_at(float excess, float rest_length, float strain_damping) {
    precise float most = damped_strain * rest_length;
    precise float calm = calm_share * strain_damping;
    return excess > most ? strain_damping : calm;
}

/// Returns the pull of one spring on the particle where `edge` starts: stiffness [(1 - L/|r|) + kappa (du . r)/|r|^2]
/// r, r = `edge` and du = `closing`, the change of r in the last substep (m), times `compression` where the spring is
/// pushed together; kappa is damping_at's. With the stiffness times phi h^2/m_inner it is a displacement (m) of an
/// inner particle. From the other end every operation sees the negated numbers, so the two pulls are opposite to the
/// bit (but for the signs of zeros, which explicit_increment loses) and momentum is kept but for the rounding of the
/// sums. A spring of zero length has no direction and does not pull.
SHARED vec3 spring_pull(vec3 edge, vec3 closing, float rest_length, float stiffness, float compression,
                        float strain_damping) {
    precise float length_squared = ordered_dot(edge, edge);
    precise float current = sqrt(length_squared);
    precise float excess = current - rest_length;
    precise float strain = excess / current;
    precise float rate =
        damping_at(excess, rest_length, strain_damping) * (ordered_dot(closing, edge) / length_squared);
    precise float pull = acting_share(stiffness, compression, excess) * (strain + rate);
    precise vec3 total = edge * (length_squared > 0.0f ? pull : 0.0f);
    return total;
}

SHARED vec3 add_pull(vec3 sum, vec3 pull) {
    precise vec3 total = sum + pull;
    return total;
}

/// Returns the tension of one stretch spring, as an extension (m) of the full stiffness of the scene (spring.h), of
/// which the micro-step uses `used_share`. It includes the strain-rate damping.
SHARED float gathered_tension(vec3 edge, vec3 closing, float rest_length, float used_share, float compression,
                              float strain_damping) {
    precise float length_squared = ordered_dot(edge, edge);
    if (!(length_squared > 0.0f)) return 0.0f;
    precise float current = sqrt(length_squared);
    precise float excess = current - rest_length;
    precise float rate = damping_at(excess, rest_length, strain_damping) * (ordered_dot(closing, edge) / current);
    precise float tension = acting_share(used_share, compression, excess) * (excess + rate);
    return tension;
}

/// Returns the increment of the displacement in one micro-step: phi h^2 (g + w (F_wind + F_springs)/m) - q d. `pull` is
/// already a displacement of an inner particle. No component of `gravity_step` is -0, so the sign of a zero pull has no
/// effect.
SHARED vec3 explicit_increment(vec3 displacement, vec3 gravity_step, vec3 force, vec3 pull, float inverse_mass,
                               float force_step, float damping_loss) {
    precise vec3 forced = gravity_step + (force * force_step + pull) * inverse_mass;
    precise vec3 increment = forced - displacement * damping_loss;
    return increment;
}

#endif
