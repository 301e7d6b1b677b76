// Moves every particle out of every collider, with friction; specialised to the kinds that the scene has.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/colliders.h"

layout(local_size_x = workgroup_width) in;
layout(constant_id = 0) const bool has_planes = false;
layout(constant_id = 1) const bool has_spheres = false;
layout(constant_id = 2) const bool has_boxes = false;
layout(constant_id = 3) const bool has_ellipsoids = false;
layout(constant_id = 4) const int round_count = 1;  // 1 when the scene has one collider: nothing can overlap
layout(push_constant) uniform Push { CollisionPush push; };
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D position;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D displacement_in;
layout(set = 0, binding = 2, rgba32f) uniform writeonly image2D displacement_out;
// A kind that the scene lacks is bound to another kind's buffer and never read (its count is 0).
layout(set = 0, binding = 3, std430) readonly buffer Planes { Collider planes[]; };
layout(set = 0, binding = 4, std430) readonly buffer Spheres { Collider spheres[]; };
layout(set = 0, binding = 5, std430) readonly buffer Boxes { Collider boxes[]; };
layout(set = 0, binding = 6, std430) readonly buffer Ellipsoids { Collider ellipsoids[]; };

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (texel.x >= push.grid.x || texel.y >= push.grid.y) return;
    vec4 start = imageLoad(position, texel);
    if (start.w == 0.0f) return;
    vec3 displacement = imageLoad(displacement_in, texel).xyz;
    bool touched = false;
    // Out of one collider may be into another: repeat until nothing is touched any more.
    for (int round = 0; round < round_count; ++round) {
        float deepest = 0.0f;
        if (has_planes)
            for (int i = 0; i < push.count.x; ++i) {
                Contact contact = plane_contact(planes[push.first.x + i], start.xyz, displacement, push.contact.x, push.contact.y);
                displacement = contact.displacement;
                deepest = contact.depth > deepest ? contact.depth : deepest;
            }
        if (has_spheres)
            for (int i = 0; i < push.count.y; ++i) {
                Contact contact = sphere_contact(spheres[push.first.y + i], start.xyz, displacement, push.contact.x, push.contact.y);
                displacement = contact.displacement;
                deepest = contact.depth > deepest ? contact.depth : deepest;
            }
        if (has_boxes)
            for (int i = 0; i < push.count.z; ++i) {
                Contact contact = box_contact(boxes[push.first.z + i], start.xyz, displacement, push.contact.x, push.contact.y);
                displacement = contact.displacement;
                deepest = contact.depth > deepest ? contact.depth : deepest;
            }
        if (has_ellipsoids)
            for (int i = 0; i < push.count.w; ++i) {
                Contact contact = ellipsoid_contact(ellipsoids[push.first.w + i], start.xyz, displacement, push.contact.x, push.contact.y);
                displacement = contact.displacement;
                deepest = contact.depth > deepest ? contact.depth : deepest;
            }
        touched = touched || deepest > 0.0f;
        if (!(deepest > push.contact.z)) break;
    }
    if (touched) imageStore(displacement_out, texel, vec4(displacement, 0.0f));
}
