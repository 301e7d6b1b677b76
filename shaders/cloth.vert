// Makes a cloth's particles vertices: the index buffer alone drives it, position and normal come from the images. Where
// it is `cut`, there are vertices on its cut springs, too.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/raster_types.h"
#include "shared/cut_types.h"
#include "include/raster_frame.h"

layout(push_constant) uniform Push { ClothPush push; };
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 2, rgba32f) uniform readonly image2D normal;
layout(location = 0) out vec3 world;
layout(location = 1) out vec3 surface_normal;
layout(location = 2) out vec2 material;  // metres along columns, rows of the undeformed cloth
layout(location = 3) out vec2 hidden;    // share of the surroundings that folds hide, of the front and the back
layout(location = lit_location) flat out LitConstants constants;
layout(location = look_location) flat out ClothLook look;
layout(constant_id = 8) const bool has_panels = false;  // some cloth has an outline
layout(set = 0, binding = 7, std430) readonly buffer PanelPlaces { vec2 panel_places[]; };  // as material
#include "include/cloth_vertex.h"

/// Returns the sine of the angle at which another particle stands above the surface, or 2, which is no sine, beyond the
/// border and where a cut or a hole lets the particle be far away.
float lift(ivec2 other, vec3 at, vec3 up, float distance_at_rest) {
    vec3 away = imageLoad(position, clamp(other, ivec2(0), ivec2(push.grid.xy) - 1)).xyz - at;
    float squared = dot(away, away);
    bool inside = all(greaterThanEqual(other, ivec2(0))) && all(lessThan(other, ivec2(push.grid.xy)));
    bool near = squared > 0.0 && squared < 2.25 * distance_at_rest * distance_at_rest;
    return inside && near ? dot(away, up) * inversesqrt(squared) : 2.0;
}

/// Averages both sides along an axis, so that a tilted flat surface counts as no fold.
float fold(ivec2 texel, ivec2 step, vec3 at, vec3 up, float distance_at_rest) {
    float ahead = lift(texel + step, at, up, distance_at_rest), behind = lift(texel - step, at, up, distance_at_rest);
    return max(ahead, behind) > 1.5 ? 0.0 : 0.5 * (ahead + behind);
}

/// Returns the share of the surroundings that folds hide from the front (x), the back (y), by four horizons.
vec2 hidden_by_folds(ivec2 texel, vec3 at, vec3 up) {
    int reach = int(push.grid.w);
    vec2 rest = push.size.xy / (vec2(push.grid.xy) - 1.0) * float(reach);
    vec2 folds = vec2(fold(texel, ivec2(reach, 0), at, up, rest.x), fold(texel, ivec2(0, reach), at, up, rest.y));
    return vec2(dot(max(folds, 0.0), vec2(0.5)), dot(max(-folds, 0.0), vec2(0.5)));
}

void main() {
    uint index = uint(gl_VertexIndex);
    uint particle = index;
    world = vertex_position(index);
    if (cut)
        if (is_cut_vertex(index)) particle = cut_vertex(index).particles.x;
    ivec2 texel = particle_texel(particle);
    surface_normal = imageLoad(normal, texel).xyz;
    vec2 on_grid = vec2(texel) / (vec2(push.grid.xy) - 1.0) * push.size.xy;
    material = on_grid;
    if (cut)
        if (is_cut_vertex(index)) material = cut_vertex(index).material.xy;
    // The rim of an outline lies where its particles were moved, and what is cut beside it moves along.
    if (has_panels)
        if (push.fabric.w >= 0.0) material += panel_places[uint(push.fabric.w) + particle] - on_grid;
    hidden = hidden_by_folds(texel, particle_position(particle), surface_normal);
    gl_Position = clip_position(world);
    gl_Position.z = depth_of_thickness(world, push.size.w, gl_Position.w);
    gl_ClipDistance[0] = clip_distance(world, push.size.w);
    constants = lit_constants();
    look = cloth_look(push);
}
