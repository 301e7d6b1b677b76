// Reads the control of the line method in the substep before, of cloths that are sewn together what seam_give.comp has
// joined. The includer has `line_control_in`, `sewn_to_others`, `sewn_places` and `push.joint`.
uint control_before(int texel) { return imageLoad(line_control_in, ivec2(texel, cloth_place())).x; }

LineControl last_control() {
    if (sewn_to_others) {
        uvec4 joined = sewn_places[push.joint].control;
        return LineControl(joined.x, joined.y, joined.z);
    }
    return LineControl(control_before(control_order), control_before(control_wrong_lines),
                       control_before(control_hold));
}
