// The thickness and friction of particles on the sheet, where a cloth has maps of them. The includer has
// include/self_cloths.h and include/self_sewn.h.
layout(constant_id = 19) const bool has_skins = false;
// By place; x: thickness kept between layers, m; y: square root of the friction coefficient.
layout(set = 0, binding = 15, std430) readonly buffer Skins { vec2 skins[]; };

vec2 skin_at(uint corner) { return skins[place_of(self_texel(corner))]; }

bool is_sewn(uint corner) { return sewn_corners[place_of(self_texel(corner))].inverse_mass > 0.0f; }

/// Returns the thickness that a pair keeps, m, and its friction. `weights`: those of its gap.
vec2 pair_skin(bool edges, uvec4 pair, vec4 weights) {
    SelfCloth one = cloth_at(self_texel(pair.x)), other = cloth_at(self_texel(pair.w));
    float thickness = self_mean_thickness(one, other), friction = self_pair_friction(one, other);
    if (has_skins) {
        vec2 a = skin_at(pair.x), b = skin_at(pair.y), c = skin_at(pair.z), d = skin_at(pair.w);
        thickness = self_thickness_there(weights, vec4(a.x, b.x, c.x, d.x));
        friction = self_friction_there(edges, weights, vec4(a.y, b.y, c.y, d.y));
    }
    // Distances are rounded as on the sheet of a member alone.
    ivec2 corner = ivec2(0);
    if (member_count > 1) corner = self_texel(pair.x) / push.member_size * push.member_size;
    float kept =
        self_pair_thickness(thickness, one, other, edges, self_texel(pair.x) - corner, self_texel(pair.y) - corner,
                            self_texel(pair.z) - corner, self_texel(pair.w) - corner);
    if (sewn)
        if (is_sewn(pair.x) || is_sewn(pair.y) || is_sewn(pair.z) || is_sewn(pair.w))
            kept = self_thickness_at_seam(kept, one, other);
    return vec2(kept, friction);
}
