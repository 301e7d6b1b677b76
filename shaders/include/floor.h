// The floor is a plane that keeps still below the camera. Everything else is clipped where it goes below the floor
// (clip_distance), so the floor shows wherever nothing else does. The encoding pass draws it together with the
// backdrop: once per pixel, without attributes to interpolate, and, since it is flat, with light that was summed in
// advance. Its shade counts for all light but the first's, which has a shadow map.
#ifndef DRAPE_FLOOR_H
#define DRAPE_FLOOR_H

/// Returns the share of the sky's light that reaches a place on the floor past what is above it (ground_shade.comp).
float open_to_sky(FloorConstants plane, vec2 place) {
    vec2 at = clamp(plane.shade.xy + plane.shade.z * place - 0.5, vec2(0.0), vec2(ground_shade_side - 2));
    ivec2 corner = ivec2(at);
    vec2 part = at - vec2(corner);
    vec4 four = imageLoad(ground_shade, corner.y * ground_shade_side + corner.x);
    vec2 two = mix(four.xy, four.zw, part.y);
    return mix(two.x, two.y, part.x);
}

/// Returns the radiance of a pixel that nothing covers: the floor's or, above its horizon, the backdrop's.
vec3 floor_radiance(FloorConstants plane, vec2 pixel, vec3 behind) {
    vec3 ray = plane.ray[0].xyz + pixel.x * plane.ray[1].xyz + pixel.y * plane.ray[2].xyz;
    bool seen = ray.y < 0.0;
    float down = seen ? ray.y : -1.0;
    vec2 slope = ray.xz / down;
    vec2 place = plane.eye.xz - plane.eye.y * slope;
    // Per pixel across and down, the derivatives of `slope` are (ray[k].xz - slope ray[k].y) / ray.y.
    vec2 change = abs(plane.ray[1].xz - slope * plane.ray[1].y) + abs(plane.ray[2].xz - slope * plane.ray[2].y);
    float cells = 1.0 / plane.eye.w;
    float lines = grid_lines(place * cells, max(abs(plane.eye.y * cells / down) * change, vec2(1e-6)));
    float away = distance(vec3(place.x, 0.0, place.y), plane.fade.xyz) / plane.fade.w;
    float lit = 1.0;
    if (shadowed) {
        vec3 there = vec3(place, 1.0);
        vec2 texel = vec2(dot(plane.shadow[0].xyz, there), dot(plane.shadow[1].xyz, there));
        // Near the horizon the texel's index exceeds what an integer holds.
        texel = clamp(texel, vec2(-8.0), vec2(shadow_map_size + 8));
        lit = light_arriving(vec3(texel, dot(plane.shadow[2].xyz, there)), vec2(plane.steady.w, plane.first.w));
    }
    float open = has_ground_shade ? open_to_sky(plane, place) : 1.0;
    vec3 radiance = lined(open * plane.steady.xyz + lit * plane.first.xyz, lines);
    return seen ? mix(radiance, behind, faded(away)) : behind;
}

#endif
