// The common motion relative to which the particles of a member are measured. The includer has include/self_cloths.h
// and `record`, and calls `load_carried` before anything has branched (docs/devices.md).
vec3 first_carried;
void load_carried() { first_carried = record[0].carried.xyz; }
vec3 carried_at(int place) {
    vec3 carried = first_carried;
    if (member_count > 1) carried = record[member_at(place)].carried.xyz;
    return carried;
}
vec3 carried_at(ivec2 texel) { return carried_at(place_of(texel)); }
