// The thickness and friction of each particle in contact with colliders, where the cloth has maps of them.
layout(constant_id = 19) const bool has_skin = false;
// x: thickness kept from colliders, m; y: square root of the friction coefficient.
layout(set = 0, binding = 16, std430) readonly buffer Skin { vec2 skin[]; };

/// Returns the skin of the particle with this index in its image; `whole` is the skin of a cloth without maps.
vec2 skin_of(int particle, vec2 whole) {
    vec2 own = whole;
    if (has_skin) own = skin[particle];
    return own;
}
