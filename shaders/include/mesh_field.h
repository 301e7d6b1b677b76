// The distance to a mesh from its field (shared/collider_types.h). colliders.h includes this where there are meshes.
#ifndef DRAPE_MESH_FIELD_H
#define DRAPE_MESH_FIELD_H

/// Returns the value at a share of the way from a to b.
SHARED float between(float a, float b, float share) {
    precise float step = (b - a) * share;
    precise float sum = a + step;
    return sum;
}

SHARED vec4 between_texels(vec4 a, vec4 b, float share) {
    return vec4(between(a.x, b.x, share), between(a.y, b.y, share), between(a.z, b.z, share), between(a.w, b.w, share));
}

/// A place in a mesh's field: the cell, the place's fractions within it, and the vector from the field to the place.
struct FieldPlace {
    int first, row, layer;  // number of the cell's first sample; samples in a row, in a layer
    vec3 share;
    vec3 off;  // m
};

SHARED FieldPlace field_place(int head, vec3 local WITH_FIELDS) {
    vec4 lower = FIELD_TEXEL(head), size = FIELD_TEXEL(head + 1);
    float spacing = lower.w;
    precise vec3 place = (local - vec3(lower.x, lower.y, lower.z)) / spacing;
    vec3 last = vec3(size.x - 1.0f, size.y - 1.0f, size.z - 1.0f);
    vec3 within =
        vec3(place.x > 0.0f ? place.x : 0.0f, place.y > 0.0f ? place.y : 0.0f, place.z > 0.0f ? place.z : 0.0f);
    within = vec3(within.x < last.x ? within.x : last.x, within.y < last.y ? within.y : last.y,
                  within.z < last.z ? within.z : last.z);
    vec3 cell = vec3(floor(within.x), floor(within.y), floor(within.z));
    cell = vec3(cell.x < last.x ? cell.x : last.x - 1.0f, cell.y < last.y ? cell.y : last.y - 1.0f,
                cell.z < last.z ? cell.z : last.z - 1.0f);
    precise vec3 share = within - cell;
    precise vec3 off = (place - within) * spacing;
    int row = int(size.x), layer = row * int(size.y);
    int first = int(cell.x) + int(cell.y) * row + int(cell.z) * layer;
    return FieldPlace(first, row, layer, share, off);
}

/// A field's distance at a place, m, and its slope along each axis, from one sample to the next.
struct FieldSlope {
    float distance;
    vec3 slope;
};

/// Interpolates linearly along each axis. Beyond the field the distance to the field is added, which gives too large
/// values where contact needs none. `step`: texels of a sample.
SHARED FieldSlope field_slope(int samples, int step, FieldPlace at WITH_FIELDS) {
    vec4 left = FIELD_TEXEL(samples + at.first * step), right = FIELD_TEXEL(samples + (at.first + 1) * step);
    vec3 share = at.share, off = at.off;
    precise vec4 along_x = vec4(right.x - left.x, right.y - left.y, right.z - left.z, right.w - left.w);
    vec4 at_x = between_texels(left, right, share.x);
    float near = between(at_x.x, at_x.y, share.y), far = between(at_x.z, at_x.w, share.y);
    precise float along_y_near = at_x.y - at_x.x;
    precise float along_y_far = at_x.w - at_x.z;
    precise float along_z = far - near;
    vec3 slope = vec3(between(between(along_x.x, along_x.y, share.y), between(along_x.z, along_x.w, share.y), share.z),
                      between(along_y_near, along_y_far, share.z), along_z);
    precise float distance = between(near, far, share.z) + sqrt(ordered_dot(off, off));
    return FieldSlope(distance, slope);
}

/// Returns how far the surface of a mesh that deforms moves near a place during the frame, apart from its pose, in its
/// own frame, m.
SHARED vec3 deformed_by(int samples, FieldPlace at WITH_FIELDS) {
    int first = samples + at.first * moving_point_texels + 2;
    int right = moving_point_texels, up = at.row * moving_point_texels, far = at.layer * moving_point_texels;
    vec4 low = between_texels(FIELD_TEXEL(first), FIELD_TEXEL(first + right), at.share.x);
    vec4 high = between_texels(FIELD_TEXEL(first + up), FIELD_TEXEL(first + up + right), at.share.x);
    vec4 near = between_texels(low, high, at.share.y);
    low = between_texels(FIELD_TEXEL(first + far), FIELD_TEXEL(first + far + right), at.share.x);
    high = between_texels(FIELD_TEXEL(first + far + up), FIELD_TEXEL(first + far + up + right), at.share.x);
    vec4 moved = between_texels(near, between_texels(low, high, at.share.y), at.share.z);
    return vec3(moved.x, moved.y, moved.z);
}

/// Returns the field of a mesh that deforms when a share of the frame is `over`. The surface there came from its place
/// at the frame's start and goes to that at its end: the field interpolates between the distances at these two places,
/// at the frame's start and end. A wall that moves by several times its thickness within a frame is therefore present
/// in between.
SHARED FieldSlope moving_field_slope(int samples, vec3 local, float over WITH_FIELDS) {
    int head = samples - field_head;
    vec3 way = deformed_by(samples, field_place(head, local FIELDS) FIELDS);
    precise vec3 from = local - way * over;
    precise vec3 to = local + way * (1.0f - over);
    FieldSlope begin = field_slope(samples, moving_point_texels, field_place(head, from FIELDS) FIELDS);
    FieldSlope end = field_slope(samples + 1, moving_point_texels, field_place(head, to FIELDS) FIELDS);
    return FieldSlope(between(begin.distance, end.distance, over),
                      vec3(between(begin.slope.x, end.slope.x, over), between(begin.slope.y, end.slope.y, over),
                           between(begin.slope.z, end.slope.z, over)));
}

/// Returns the distance to a mesh and its normal from its field; a mesh that deforms is taken after this share of the
/// substep.
SHARED SurfacePoint mesh_surface(ColliderRecord collider, vec3 local, float share WITH_FIELDS) {
    int samples = int(collider.way_out.x) + field_head;
    float substep = FIELD_TEXEL(samples - 1).w;
    FieldSlope found;
    if (substep > 0.0f) {
        precise float over = collider.way_out.z - substep * (1.0f - share);
        found = moving_field_slope(samples, local, over FIELDS);
    } else {
        found = field_slope(samples, 1, field_place(samples - field_head, local FIELDS) FIELDS);
    }
    precise float steepness = sqrt(ordered_dot(found.slope, found.slope));
    precise float distance = found.distance - collider.way_out.y;
    if (!(steepness > 0.0f)) return SurfacePoint(vec3(0.0f, 1.0f, 0.0f), distance);
    precise vec3 normal = found.slope / steepness;
    return SurfacePoint(normal, distance);
}

#endif
