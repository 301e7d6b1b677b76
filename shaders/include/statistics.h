// Statistics of a cloth's state, from one particle and the springs that it owns, and how two records join. A strain is
// (length - rest length) / rest length. Every spring that exists counts once, whatever its share of the stiffness, so
// that "RMS over the springs" is what anyone computes from exported positions. A value that is not finite is counted by
// its bits, before any comparison could hide it (max(NaN, 0) may be 0), and adds nothing else, so that the other
// numbers still say something.
#ifndef DRAPE_STATISTICS_H
#define DRAPE_STATISTICS_H

#include "include/spring.h"
#include "shared/statistics_types.h"

const float lowest_float = -3.402823466e38f;
const uint no_particle = 0xffffffffu;

SHARED bool is_finite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }

SHARED bool is_finite(vec3 v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }

/// Returns the sums and maxima of nothing: -0 + x is x for every x.
SHARED StatisticsRecord empty_statistics() {
    vec4 none = vec4(-0.0f, -0.0f, -0.0f, -0.0f);
    return StatisticsRecord(none, none, vec4(lowest_float, lowest_float, lowest_float, lowest_float),
                            vec4(0.0f, 0.0f, 0.0f, 0.0f), none, none, none, none, uvec4(0u, no_particle, 0u, 0u),
                            uvec4(no_particle, no_particle, no_particle, no_particle));
}

SHARED vec4 ordered_sum(vec4 a, vec4 b) {
    precise vec4 sum = vec4(a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w);
    return sum;
}

SHARED vec4 larger(vec4 a, vec4 b) {
    return vec4(a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y, a.z > b.z ? a.z : b.z, a.w > b.w ? a.w : b.w);
}

/// Returns the place of the larger of two values; of equal ones the lower index, whatever the order of joining.
SHARED uint place_of_larger(float a, float b, uint place_a, uint place_b) {
    return a > b ? place_a : b > a ? place_b : place_a < place_b ? place_a : place_b;
}

SHARED uvec4 places_of_larger(StatisticsRecord a, StatisticsRecord b) {
    return uvec4(place_of_larger(a.extents.x, b.extents.x, a.places.x, b.places.x),
                 place_of_larger(a.extents.y, b.extents.y, a.places.y, b.places.y),
                 place_of_larger(a.extents.z, b.extents.z, a.places.z, b.places.z),
                 place_of_larger(a.extents.w, b.extents.w, a.places.w, b.places.w));
}

SHARED StatisticsRecord joined(StatisticsRecord a, StatisticsRecord b) {
    return StatisticsRecord(ordered_sum(a.squares, b.squares), ordered_sum(a.moments, b.moments),
                            larger(a.strains, b.strains), larger(a.extents, b.extents), ordered_sum(a.errors, b.errors),
                            ordered_sum(a.momentum, b.momentum), ordered_sum(a.mean, b.mean),
                            ordered_sum(a.spin, b.spin),
                            uvec4(a.counts.x + b.counts.x, a.counts.y < b.counts.y ? a.counts.y : b.counts.y,
                                  a.counts.z + b.counts.z, a.counts.w + b.counts.w),
                            places_of_larger(a, b));
}

/// Returns the mass of a particle in a cloth without holes, in units of an inner particle's.
SHARED float border_mass_share(ivec2 particle, ivec2 grid) {
    float across = particle.x == 0 || particle.x == grid.x - 1 ? 0.5f : 1.0f;
    float down = particle.y == 0 || particle.y == grid.y - 1 ? 0.5f : 1.0f;
    precise float share = across * down;
    return share;
}

/// Returns the statistics of a particle without its springs. It counts as not finite if its position or its velocity is
/// not. `velocity`: h times that of the frame's end, m; `displacement`: h times the mean one of the last substep.
SHARED StatisticsRecord particle_statistics(vec3 position, vec3 displacement, vec3 velocity, float share,
                                            vec3 reference, uint index) {
    StatisticsRecord record = empty_statistics();
    bool finite = is_finite(position) && is_finite(velocity);
    precise vec3 arm = position - reference;
    precise vec3 moment = arm * share;
    precise vec3 momentum = velocity * share;
    precise vec3 mean = displacement * share;
    vec3 spin = ordered_cross(arm, mean);
    precise float moved_squared = ordered_dot(velocity, velocity);
    precise float moving = share * moved_squared;
    record.squares.w = finite ? moving : -0.0f;
    record.moments = finite ? vec4(moment.x, moment.y, moment.z, share) : record.moments;
    record.momentum = finite ? vec4(momentum.x, momentum.y, momentum.z, -0.0f) : record.momentum;
    record.mean = finite ? vec4(mean.x, mean.y, mean.z, -0.0f) : record.mean;
    record.spin = finite ? vec4(spin.x, spin.y, spin.z, -0.0f) : record.spin;
    record.extents.x = finite ? ordered_dot(position, position) : 0.0f;
    record.extents.y = finite ? moved_squared : 0.0f;
    uint place = finite ? index : no_particle;
    record.places = uvec4(place, place, place, no_particle);
    record.counts = uvec4(finite ? 0u : 1u, finite ? no_particle : index, 0u, 0u);
    return record;
}

/// Returns a particle's `record` plus the spring from it to another; `first` is finite. `rest_length`, m, and the
/// spring's `share` of the stiffness: 0 = no such spring. `half_stiffness`: k/2, N/m, of which a spring pushed together
/// keeps `compression`. `shear`: the spring is a diagonal. `tension`: applied to the spring, as an extension of its
/// whole stiffness (m). The stretch error is the tension that would balance the spring beyond it, over the rest length;
/// a perfect solver makes it zero, and shear springs have none. Nothing branches: on the default device all numbers of
/// the record would be blended at the end of every branch, which takes longer than it saves.
SHARED StatisticsRecord add_spring_strain(StatisticsRecord record, vec3 first, vec3 second, float rest_length,
                                          float half_stiffness, float share, float compression, float tension,
                                          bool shear) {
    bool counts = rest_length > 0.0f && share > 0.0f && is_finite(second);
    precise vec3 edge = second - first;
    precise float current = sqrt(ordered_dot(edge, edge));
    precise float extension = current - rest_length;
    precise float strain = extension / rest_length;
    precise float square = strain * strain;
    precise float stored = acting_share(share, compression, extension) * half_stiffness * (extension * extension);
    float squared = counts ? square : -0.0f, energy = counts ? stored : -0.0f;
    float longer = counts ? strain : lowest_float, shorter = counts ? -strain : lowest_float;
    record.squares =
        ordered_sum(record.squares, shear ? vec4(-0.0f, squared, energy, -0.0f) : vec4(squared, -0.0f, energy, -0.0f));
    record.strains = larger(record.strains, shear ? vec4(lowest_float, longer, lowest_float, shorter)
                                                  : vec4(longer, lowest_float, shorter, lowest_float));
    record.counts.z += counts && !shear ? 1u : 0u;
    record.counts.w += counts && shear ? 1u : 0u;
    if (shear) return record;  // `shear` is a constant in every call
    precise float error = (balancing_tension(extension, compression) - tension) / rest_length;
    precise float squared_error = error * error;
    record.errors = ordered_sum(record.errors, vec4(counts ? squared_error : -0.0f, -0.0f, -0.0f, -0.0f));
    uint place = place_of_larger(record.extents.w, abs(error), record.places.w, record.places.x);
    record.places.w = counts ? place : record.places.w;
    record.extents = larger(record.extents, vec4(0.0f, 0.0f, 0.0f, counts ? abs(error) : 0.0f));
    return record;
}

/// Returns a particle's `record` plus the energy of a bending element or a cell's twist that deviates by `beyond` from
/// its rest (m). `half_constant` is half of its constant (N/m), `share` the share of it that acts, 0 = the element does
/// not exist (include/bend.h).
SHARED StatisticsRecord add_bending(StatisticsRecord record, vec3 beyond, float half_constant, float share) {
    bool counts = share > 0.0f && is_finite(beyond);
    precise float stored = share * half_constant * ordered_dot(beyond, beyond);
    record.squares = ordered_sum(record.squares, vec4(-0.0f, -0.0f, counts ? stored : -0.0f, -0.0f));
    return record;
}

#endif
