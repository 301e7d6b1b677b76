// Looks up the cloth at a place on the sheet (shared/self_contact_types.h). The includer has `push`.
#include "include/places.h"
layout(constant_id = 0) const int cloth_count = 1;   // cloths of the scene; a single one needs no look-up
layout(constant_id = 2) const int member_count = 1;  // members of the ensemble; each has as many cloths
layout(set = 0, binding = 2, std430) readonly buffer Owners { int owners[]; };  // -1: no cloth
layout(set = 0, binding = 3, std430) readonly buffer Cloths { SelfCloth cloths[]; };

int place_of(ivec2 texel) { return texel.y * push.grid.x + texel.x; }
ivec2 texel_of(int place) { return texel_of(place, push.grid.x); }
int owner_of(int place) { return cloth_count == 1 ? 0 : owners[place]; }
int cloths_each() { return cloth_count / member_count; }
/// Returns the member whose cloth is at a place.
int member_at(int place) { return member_count == 1 ? 0 : max(owner_of(place), 0) / cloths_each(); }
/// Returns the cloth at a place, where one must be.
SelfCloth cloth_at(ivec2 texel) {
    // On the default device a struct in a buffer is loaded for every invocation, so a lone cloth comes from `push`.
    SelfCloth cloth = push.cloth;
    if (cloth_count > 1) cloth = cloths[max(owner_of(place_of(texel)), 0)];
    return cloth;
}
