// A collider's frame: where it is at the end of a substep, and how it moves in it.
#ifndef DRAPE_COLLIDER_FRAME_H
#define DRAPE_COLLIDER_FRAME_H

#include "include/vector.h"
#include "shared/collider_types.h"

SHARED vec3 local_point(ColliderRecord collider, vec3 world) {
    precise vec3 from_center = world - vec3(collider.pose_x.w, collider.pose_y.w, collider.pose_z.w);
    precise vec3 local = vec3(collider.pose_x.x, collider.pose_x.y, collider.pose_x.z) * from_center.x +
                         vec3(collider.pose_y.x, collider.pose_y.y, collider.pose_y.z) * from_center.y +
                         vec3(collider.pose_z.x, collider.pose_z.y, collider.pose_z.z) * from_center.z;
    return local;
}

SHARED vec3 world_direction(ColliderRecord collider, vec3 local) {
    return vec3(ordered_dot(vec3(collider.pose_x.x, collider.pose_x.y, collider.pose_x.z), local),
                ordered_dot(vec3(collider.pose_y.x, collider.pose_y.y, collider.pose_y.z), local),
                ordered_dot(vec3(collider.pose_z.x, collider.pose_z.y, collider.pose_z.z), local));
}

/// Returns how far the collider's material at `local` moved during the substep, world frame, m.
SHARED vec3 surface_displacement(ColliderRecord collider, vec3 local) {
    precise vec3 turned = vec3(ordered_dot(vec3(collider.change_x.x, collider.change_x.y, collider.change_x.z), local),
                               ordered_dot(vec3(collider.change_y.x, collider.change_y.y, collider.change_y.z), local),
                               ordered_dot(vec3(collider.change_z.x, collider.change_z.y, collider.change_z.z), local));
    precise vec3 moved = turned + vec3(collider.change_x.w, collider.change_y.w, collider.change_z.w);
    return moved;
}

#endif
