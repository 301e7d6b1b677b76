// What seams make of places on the sheet (shared/self_contact_types.h).
layout(constant_id = 33) const bool sewn = false;
layout(set = 0, binding = 20, std430) readonly buffer SewnCorners { SelfSewn sewn_corners[]; };

/// Returns the place at which what contact does to a particle is summed.
int leader_of(int place) {
    int leader = place;
    if (sewn) leader = sewn_corners[place].leader;
    return leader;
}

/// Returns the thickness, m, that limits how contact changes a particle's motion.
float own_thickness(int place, float of_cloth) {
    float thickness = of_cloth;
    if (sewn) thickness = sewn_corners[place].thickness;
    return thickness;
}
