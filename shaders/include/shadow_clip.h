vec4 shadow_clip(vec3 world) {
    vec3 at = shadow_position(frame[0].shadow_from_world, world);
    return vec4(at.xy * (2.0 / float(shadow_map_size)) - 1.0, at.z, 1.0);
}
