// Contact of the cloth's edges and triangles with edges and corners of boxes and meshes, which the contact of particles
// (colliders.h) does not handle. An edge of the cloth and an edge of the box, or a triangle and a corner, that have
// passed each other are moved apart along the direction in which the least motion is needed (separating axes), by
// shares that follow from the touching point's weights in its triangle. A particle takes, for each direction, only the
// largest motion that a triangle around it asks for, so that neighbours that ask for the same are not counted twice.
// The edges of a mesh are known by its field of distances alone; there the planes that touch the mesh nearest to the
// corners of a triangle show whether an edge or a corner lies between them.
#ifndef DRAPE_COLLIDER_EDGES_H
#define DRAPE_COLLIDER_EDGES_H

#include "include/colliders.h"

#if COLLIDER_KINDS != 6
#error "collider_edges.comp visits boxes, and takes all after the capsules for meshes"
#endif

/// A corner of a triangle.
struct CutCorner {
    vec3 local;         // m, in the box's frame, now
    vec3 displacement;  // m, world frame
    float weight;       // relative inverse mass
};

/// The shortest way out of the box along one direction.
struct BoxCut {
    vec3 normal;  // local, outward, unit length
    float depth;  // along it, m; not > 0: outside
    vec3 shares;  // weights of the corners at the touching point
    vec3 way;     // along which contact presses, local, outward, unit length
};

SHARED BoxCut no_cut() { return BoxCut(vec3(0.0f, 1.0f, 0.0f), 0.0f, vec3(1.0f, 0.0f, 0.0f), vec3(0.0f, 1.0f, 0.0f)); }

SHARED float smaller_of(float a, float b) { return a < b ? a : b; }
SHARED float larger_of(float a, float b) { return a > b ? a : b; }

/// Returns by how much (m) the interval from `low` to `high` along an axis reaches past the nearer of two faces.
SHARED float past_faces(float low, float high, float half_extent) {
    precise float up = half_extent - low;
    precise float down = half_extent + high;
    return smaller_of(up, down);
}

/// Returns by how much (m) a triangle reaches past the faces; not > 0 where one of them separates it from the box.
SHARED float past_all_faces(vec3 a, vec3 b, vec3 c, vec3 half_extents) {
    float x = past_faces(smaller_of(a.x, smaller_of(b.x, c.x)), larger_of(a.x, larger_of(b.x, c.x)), half_extents.x);
    float y = past_faces(smaller_of(a.y, smaller_of(b.y, c.y)), larger_of(a.y, larger_of(b.y, c.y)), half_extents.y);
    float z = past_faces(smaller_of(a.z, smaller_of(b.z, c.z)), larger_of(a.z, larger_of(b.z, c.z)), half_extents.z);
    return smaller_of(x, smaller_of(y, z));
}

/// Returns how deep (m) a particle is inside, 0 outside; contact of particles moves it by this depth.
SHARED float inside_faces(vec3 a, vec3 half_extents) {
    float depth = past_all_faces(a, a, a, half_extents);
    return depth > 0.0f ? depth : 0.0f;
}

/// Returns how far an edge of the cloth is past an edge of the box, as seen along the latter; `from` and `along`
/// describe the cloth's edge. xy: direction; z: depth, m, negative outside; w: share of the edge's far end.
SHARED vec4 past_box_edge(vec2 from, vec2 along, vec2 half_extents) {
    precise float squared = along.x * along.x + along.y * along.y;
    // An edge that looks like a point from here is judged by the other two directions.
    if (!(squared > 0.0f)) return vec4(0.0f, 0.0f, 3.0e38f, 0.0f);
    precise float side = along.x * from.y - along.y * from.x;
    precise float reach = half_extents.x * abs(along.y) + half_extents.y * abs(along.x);
    float length = sqrt(squared);
    precise float depth = (reach - abs(side)) / length;
    float turn = side < 0.0f ? -1.0f : 1.0f;
    precise vec2 normal = vec2(-along.y * turn / length, along.x * turn / length);
    precise vec2 to_edge = vec2((normal.x < 0.0f ? -half_extents.x : half_extents.x) - from.x,
                                (normal.y < 0.0f ? -half_extents.y : half_extents.y) - from.y);
    precise float share = (to_edge.x * along.x + to_edge.y * along.y) / squared;
    share = share < 0.0f ? 0.0f : share > 1.0f ? 1.0f : share;
    return vec4(normal.x, normal.y, depth, share);
}

/// Contact leads out along a mean of normals. If that is steeper against one of them than this cosine, the collider is
/// too sharp there for the cloth, or too sharp or thin for its samples, and the mean is not taken.
const float least_cosine = 0.3f;

/// The particles before and after the ends of an edge of the cloth, in the line that it continues; local, m.
struct EdgeLine {
    vec3 before, after;
};

/// Returns where the line from `far` through `end` goes on.
SHARED vec3 mirrored(vec3 far, vec3 end) {
    precise vec3 on = end * 2.0f - far;
    return on;
}

/// Returns the vector with unit length, or zero.
SHARED vec3 unit_of(vec3 v) {
    float squared = ordered_dot(v, v);
    if (!(squared > 0.0f)) return v;
    precise vec3 unit = v / sqrt(squared);
    return unit;
}

/// Returns the cloth's direction between a and b as the mean of that before a and that after b.
SHARED vec3 direction_between(vec3 before, vec3 a, vec3 b, vec3 after) {
    precise vec3 to_a = a - before;
    precise vec3 from_b = after - b;
    precise vec3 both = unit_of(to_a) + unit_of(from_b);
    return unit_of(both);
}

/// Returns the way along which a contact near an edge of a box presses. Cloth bends over an edge within a cell, where
/// its particles cannot show it: pressed along the normals of faces and links it would be caught by the edge at every
/// particle, as a chain of stiff links is, and hold several times what friction does. So it is pressed along its own
/// normal, which is smooth: that of the faces it lies between. `normal`: that of the contact; `bent`: of the cloth;
/// `sides`: signs of the faces that are near, 0 for the others.
SHARED vec3 bent_way(vec3 normal, vec3 bent, vec3 sides) {
    precise vec3 along = bent * sides;
    vec3 between_faces =
        vec3(along.x > 0.0f ? bent.x : 0.0f, along.y > 0.0f ? bent.y : 0.0f, along.z > 0.0f ? bent.z : 0.0f);
    vec3 way = unit_of(between_faces);
    return ordered_dot(way, normal) > least_cosine ? way : normal;
}

/// Lets a cut press along the normal of the cloth that bends over the edge; `direction`: the cloth's across it.
SHARED BoxCut bent_cut(BoxCut cut, vec3 touching, vec3 direction) {
    precise vec3 bent = cut.normal - direction * ordered_dot(cut.normal, direction);
    vec3 sides = vec3(cut.normal.x == 0.0f ? 0.0f : touching.x, cut.normal.y == 0.0f ? 0.0f : touching.y,
                      cut.normal.z == 0.0f ? 0.0f : touching.z);
    return BoxCut(cut.normal, cut.depth, cut.shares, bent_way(cut.normal, bent, sides));
}

/// Finds how the box's edges alone cut an edge; where an end of the edge is as far inside, contact of particles leads
/// it out.
SHARED BoxCut edge_in_box(vec3 a, vec3 b, EdgeLine line, vec3 half_extents) {
    float known = larger_of(inside_faces(a, half_extents), inside_faces(b, half_extents));
    precise vec3 along = b - a;
    vec4 x = past_box_edge(vec2(a.y, a.z), vec2(along.y, along.z), vec2(half_extents.y, half_extents.z));
    vec4 y = past_box_edge(vec2(a.z, a.x), vec2(along.z, along.x), vec2(half_extents.z, half_extents.x));
    vec4 z = past_box_edge(vec2(a.x, a.y), vec2(along.x, along.y), vec2(half_extents.x, half_extents.y));
    float depth = smaller_of(x.z, smaller_of(y.z, z.z));
    if (!(depth > known) || !(past_all_faces(a, b, b, half_extents) > 0.0f)) return no_cut();
    vec3 normal = x.z <= depth ? vec3(0.0f, x.x, x.y) : y.z <= depth ? vec3(y.y, 0.0f, y.x) : vec3(z.x, z.y, 0.0f);
    float share = x.z <= depth ? x.w : y.z <= depth ? y.w : z.w;
    precise float rest = 1.0f - share;
    precise vec3 touching = a + along * share;
    return bent_cut(BoxCut(normal, depth, vec3(rest, share, 0.0f), normal), touching,
                    direction_between(line.before, a, b, line.after));
}

/// A corner of the box past a triangle's plane counts as under the triangle up to this far beside it, in units of the
/// triangle's weights. Otherwise it would slip through under an edge between two triangles; with the margin, contact
/// moves that edge aside, and the corner is then under one of the triangles.
const float corner_margin = 0.2f;

SHARED float not_below_zero(float x) { return x > 0.0f ? x : 0.0f; }

/// Finds how a corner of the box cuts a triangle.
SHARED BoxCut corner_in_triangle(vec3 a, vec3 b, vec3 c, vec3 half_extents) {
    float least = past_all_faces(a, b, c, half_extents);
    precise vec3 ab = b - a;
    precise vec3 ac = c - a;
    vec3 area = ordered_cross(ab, ac);
    float squared = ordered_dot(area, area);
    if (!(squared > 0.0f) || !(least > 0.0f)) return no_cut();
    float turn = ordered_dot(area, a) < 0.0f ? -1.0f : 1.0f;
    precise vec3 normal = area * (turn / sqrt(squared));
    vec3 corner =
        vec3(normal.x < 0.0f ? -half_extents.x : half_extents.x, normal.y < 0.0f ? -half_extents.y : half_extents.y,
             normal.z < 0.0f ? -half_extents.z : half_extents.z);
    precise vec3 to_corner = corner - a;
    float depth = ordered_dot(to_corner, normal);
    if (!(depth > 0.0f) || !(depth < least)) return no_cut();
    precise float of_b = ordered_dot(ordered_cross(to_corner, ac), area) / squared;
    precise float of_c = ordered_dot(ordered_cross(ab, to_corner), area) / squared;
    precise float of_a = 1.0f - of_b - of_c;
    if (of_a < -corner_margin || of_b < -corner_margin || of_c < -corner_margin) return no_cut();
    vec3 inside = vec3(not_below_zero(of_a), not_below_zero(of_b), not_below_zero(of_c));
    precise vec3 shares = inside / (inside.x + inside.y + inside.z);
    return BoxCut(normal, depth, shares, normal);
}

/// Returns the point of a triangle at which the collider touches it.
SHARED vec3 touching_point(BoxCut cut, CutCorner a, CutCorner b, CutCorner c) {
    precise vec3 touching = a.local * cut.shares.x + b.local * cut.shares.y + c.local * cut.shares.z;
    return touching;
}

/// By how much a particle is moved, m.
struct Taken {
    vec3 by;    // local
    float led;  // how much of it leads the particle out of an overlap in which it began the substep
};

/// Returns `taken`, by which the triangle's first corner has already been moved, extended by what a cut asks for beyond
/// it. `surface`: displacement of the collider at the touching point, m, world frame.
SHARED Taken with_cut(Taken taken, BoxCut cut, CutCorner a, CutCorner b, CutCorner c, ColliderRecord collider,
                      vec3 surface, float recovery) {
    precise float mobility = a.weight * cut.shares.x * cut.shares.x + b.weight * cut.shares.y * cut.shares.y +
                             c.weight * cut.shares.z * cut.shares.z;
    if (!(cut.depth > 0.0f) || !(mobility > 0.0f)) return taken;
    // As in collider_contact, a depth that existed when the substep began is resolved slowly.
    precise vec3 motion = a.displacement * cut.shares.x + b.displacement * cut.shares.y + c.displacement * cut.shares.z;
    precise vec3 relative = motion - surface;
    precise float inward = -ordered_dot(world_direction(collider, cut.normal), relative);
    precise float before = cut.depth - inward;
    // Cloth that leaves by one face must not be led to another one.
    vec3 way_out = vec3(collider.way_out.x, collider.way_out.y, collider.way_out.z);
    if (before > recovery && has_way_out(collider) && ordered_dot(cut.normal, way_out) < 0.5f) return taken;
    float overlap = not_below_zero(before);
    float leads = smaller_of(overlap, recovery);
    precise float depth = cut.depth - overlap + leads;
    if (!(depth > 0.0f)) return taken;
    precise float share = a.weight * cut.shares.x / (mobility * ordered_dot(cut.way, cut.normal));
    precise float asked = depth * share - ordered_dot(taken.by, cut.way);
    if (!(asked > 0.0f)) return taken;
    precise vec3 sum = taken.by + cut.way * asked;
    precise float led = smaller_of(depth, leads) * share;
    return Taken(sum, larger_of(taken.led, led));
}

SHARED Taken with_box_cut(Taken taken, BoxCut cut, CutCorner a, CutCorner b, CutCorner c, ColliderRecord collider,
                          float recovery) {
    vec3 surface = surface_displacement(collider, touching_point(cut, a, b, c));
    return with_cut(taken, cut, a, b, c, collider, surface, recovery);
}

/// Returns `taken` extended by everything that a triangle asks of its first corner; `to_b`, `to_c`: the lines of its
/// edges from there.
SHARED Taken with_triangle(Taken taken, CutCorner a, CutCorner b, CutCorner c, EdgeLine to_b, EdgeLine to_c,
                           ColliderRecord collider, float recovery) {
    vec3 half_extents = vec3(collider.shape.x, collider.shape.y, collider.shape.z);
    taken = with_box_cut(taken, edge_in_box(a.local, b.local, to_b, half_extents), a, b, c, collider, recovery);
    taken = with_box_cut(taken, edge_in_box(a.local, c.local, to_c, half_extents), a, c, b, collider, recovery);
    return with_box_cut(taken, corner_in_triangle(a.local, b.local, c.local, half_extents), a, b, c, collider,
                        recovery);
}

/// Returns whether an edge of the cloth shorter than `reach` that ends at a particle can meet an edge of the box.
SHARED bool near_box_edge(vec3 local, vec3 half_extents, float reach) {
    precise vec3 beyond = vec3(abs(local.x), abs(local.y), abs(local.z)) - half_extents;
    int along = (beyond.x > -reach ? 1 : 0) + (beyond.y > -reach ? 1 : 0) + (beyond.z > -reach ? 1 : 0);
    return along >= 2 && beyond.x < reach && beyond.y < reach && beyond.z < reach;
}

/// Signs of a point's coordinates where the face on that side is within reach, otherwise 0.
SHARED vec3 near_sides(vec3 local, vec3 half_extents, float reach) {
    precise vec3 beyond = vec3(abs(local.x), abs(local.y), abs(local.z)) - half_extents;
    return vec3(beyond.x > -reach ? local.x : 0.0f, beyond.y > -reach ? local.y : 0.0f,
                beyond.z > -reach ? local.z : 0.0f);
}

/// A way that leads so little aside needs no step of its own.
const float same_way = 0.995f;

/// Returns the displacement of a particle near an edge of a box after contact along the cloth's normal. `across`:
/// normal of the cloth, local, of either sign; `reach`: how far from an edge its links may bend over it, m.
SHARED vec3 bent_contact(ColliderRecord collider, vec3 start, vec3 displacement, vec3 across, float reach,
                         float thickness, float friction WITH_FIELDS) {
    vec3 half_extents = size_of(collider);
    float length = length_of(displacement);
    if (has_way_out(collider) || goes_far(kind_box, half_extents, length, collider.way_out.w, thickness))
        return displacement;
    Contact plain = collider_contact(kind_box, collider, start, displacement, thickness, friction, 0.0f, false FIELDS);
    if (!(plain.depth > 0.0f)) return displacement;
    vec3 local = local_point(collider, moved_position(start, displacement));
    vec3 normal = box_surface(local, half_extents).normal;
    float side = ordered_dot(across, normal) < 0.0f ? -1.0f : 1.0f;
    precise vec3 bent = across * side;
    vec3 way = bent_way(normal, bent, near_sides(local, half_extents, reach));
    float slope = ordered_dot(way, normal);
    if (slope > same_way) return displacement;
    precise float depth = plain.depth / slope;
    vec3 surface = vec3(plain.grip.x, plain.grip.y, plain.grip.z);
    return contact_displacement(displacement, surface, world_direction(collider, way), depth, plain.grip.w).value;
}

/// Returns the plane that touches a mesh where the mesh is nearest to a triangle's corner: normal (unit, outward,
/// local) and the corner's distance from the plane, m, negative inside.
SHARED vec4 touching_plane(vec3 local, ColliderRecord mesh WITH_FIELDS) {
    SurfacePoint surface = mesh_surface(mesh, local, 1.0f FIELDS);
    return vec4(surface.normal.x, surface.normal.y, surface.normal.z, surface.distance);
}

SHARED vec3 normal_of(vec4 plane) { return vec3(plane.x, plane.y, plane.z); }

/// Returns how deep (m) a corner is inside, 0 outside.
SHARED float inside_plane(vec4 plane) { return plane.w < 0.0f ? -plane.w : 0.0f; }

/// Returns a cut at `touching`, which is `depth` (m) below each of the planes found at the corners. `mean` is the mean
/// of their normals, weighted by the shares in which they balance; contact of particles alone resolves the depth
/// `known`.
SHARED BoxCut cut_of_planes(vec3 touching, float depth, vec3 mean, vec3 shares, float known,
                            ColliderRecord mesh WITH_FIELDS) {
    precise float cosine = sqrt(ordered_dot(mean, mean));
    if (!(depth > known) || !(cosine > least_cosine)) return no_cut();
    // Planes overestimate the depth of a point in a convex shape; samples underestimate it by less than half their
    // spacing.
    precise float blunt = 0.5f * FIELD_TEXEL(int(mesh.way_out.x)).w;
    precise float seen = -mesh_surface(mesh, touching, 1.0f FIELDS).distance;
    precise float most = seen + blunt;
    float inside = smaller_of(depth, most);
    if (!(inside > known)) return no_cut();
    precise vec3 normal = mean / cosine;
    precise float way = inside / cosine;
    return BoxCut(normal, way, shares, normal);
}

/// Finds how an edge of the mesh cuts an edge that leads into the mesh from both of its ends.
SHARED BoxCut edge_in_mesh(vec3 a, vec3 b, vec4 at_a, vec4 at_b, ColliderRecord mesh WITH_FIELDS) {
    precise vec3 along = b - a;
    float fall = -ordered_dot(normal_of(at_a), along);
    float rise = ordered_dot(normal_of(at_b), along);
    if (!(fall > 0.0f) || !(rise > 0.0f)) return no_cut();
    precise float both = fall + rise;
    precise float share = (at_a.w - at_b.w + rise) / both;
    if (!(share > 0.0f) || !(share < 1.0f)) return no_cut();
    precise float rest = 1.0f - share;
    precise vec3 touching = a + along * share;
    precise float depth = fall * share - at_a.w;
    precise vec3 mean = (normal_of(at_a) * rise + normal_of(at_b) * fall) / both;
    return cut_of_planes(touching, depth, mean, vec3(rest, share, 0.0f),
                         larger_of(inside_plane(at_a), inside_plane(at_b)), mesh FIELDS);
}

/// Finds how a corner of the mesh cuts a triangle that leads into the mesh from all three of its corners.
SHARED BoxCut triangle_in_mesh(vec3 a, vec3 b, vec3 c, vec4 at_a, vec4 at_b, vec4 at_c,
                               ColliderRecord mesh WITH_FIELDS) {
    precise vec3 ab = b - a;
    precise vec3 ac = c - a;
    vec3 to_b =
        vec3(ordered_dot(normal_of(at_a), ab), ordered_dot(normal_of(at_b), ab), ordered_dot(normal_of(at_c), ab));
    vec3 to_c =
        vec3(ordered_dot(normal_of(at_a), ac), ordered_dot(normal_of(at_b), ac), ordered_dot(normal_of(at_c), ac));
    // With these weights the planes' mean has no slope along the triangle.
    vec3 weights = ordered_cross(to_b, to_c);
    precise float sum = weights.x + weights.y + weights.z;
    precise vec3 held = weights / sum;
    if (!(held.x > 0.0f) || !(held.y > 0.0f) || !(held.z > 0.0f)) return no_cut();
    // The planes have equal height where these two lines meet, in weights of b and c.
    precise vec2 first = vec2(to_b.x - to_b.y, to_c.x - to_c.y);
    precise vec2 second = vec2(to_b.x - to_b.z, to_c.x - to_c.z);
    precise float ends_first = at_b.w - to_b.y - at_a.w;
    precise float ends_second = at_c.w - to_c.z - at_a.w;
    precise float area = first.x * second.y - first.y * second.x;
    precise float of_b = (ends_first * second.y - ends_second * first.y) / area;
    precise float of_c = (first.x * ends_second - second.x * ends_first) / area;
    precise float of_a = 1.0f - of_b - of_c;
    if (!(of_a > 0.0f) || !(of_b > 0.0f) || !(of_c > 0.0f)) return no_cut();
    precise vec3 touching = a + ab * of_b + ac * of_c;
    precise float depth = -(at_a.w + to_b.x * of_b + to_c.x * of_c);
    precise vec3 mean = normal_of(at_a) * held.x + normal_of(at_b) * held.y + normal_of(at_c) * held.z;
    float known = larger_of(inside_plane(at_a), larger_of(inside_plane(at_b), inside_plane(at_c)));
    return cut_of_planes(touching, depth, mean, vec3(of_a, of_b, of_c), known, mesh FIELDS);
}

/// Returns the mesh itself, without the growth that contact of particles applies.
SHARED ColliderRecord true_mesh(ColliderRecord collider) {
    collider.way_out.y = 0.0f;
    return collider;
}

/// Returns the mesh without a way out, since cloth leaves a mesh at the nearest surface.
SHARED ColliderRecord without_way_out(ColliderRecord collider) {
    collider.way_out = vec4(0.0f, 0.0f, 0.0f, collider.way_out.w);
    return collider;
}

const int edges_around_particle = 6;

/// Returns the other end of edge k (0..5) around a particle, relative to it.
SHARED ivec2 edge_around(int k) {
    if (k < 2) return ivec2(k == 0 ? 1 : -1, 0);
    if (k < 4) return ivec2(0, k == 2 ? 1 : -1);
    return ivec2(k == 4 ? 1 : -1, k == 4 ? -1 : 1);
}

/// Returns whether an edge leads from its first end below the touching plane there; otherwise nothing can cut it.
SHARED bool leads_below(vec3 a, vec3 b, vec4 at_a) {
    precise vec3 along = b - a;
    return -ordered_dot(normal_of(at_a), along) > at_a.w;
}

/// Returns how far the surface of a mesh nearest to `local` moved during the substep, world frame, m.
SHARED vec3 mesh_displacement(ColliderRecord collider, vec3 local WITH_FIELDS) {
    vec3 moved = surface_displacement(collider, local);
    if (!is_deforming(kind_mesh, collider FIELDS)) return moved;
    precise vec3 all = moved + deformation(collider, local FIELDS);
    return all;
}

SHARED Taken with_mesh_cut(Taken taken, BoxCut cut, CutCorner a, CutCorner b, CutCorner c, ColliderRecord collider,
                           float recovery WITH_FIELDS) {
    vec3 surface = mesh_displacement(collider, touching_point(cut, a, b, c) FIELDS);
    return with_cut(taken, cut, a, b, c, without_way_out(collider), surface, recovery);
}

/// Returns `taken` extended by everything that a triangle in contact with a mesh asks of its first corner, whose
/// touching plane is given.
SHARED Taken with_mesh_triangle(Taken taken, CutCorner a, CutCorner b, CutCorner c, vec4 at_a, ColliderRecord collider,
                                float recovery WITH_FIELDS) {
    if (!leads_below(a.local, b.local, at_a) && !leads_below(a.local, c.local, at_a)) return taken;
    ColliderRecord mesh = true_mesh(collider);
    vec4 at_b = touching_plane(b.local, mesh FIELDS);
    vec4 at_c = touching_plane(c.local, mesh FIELDS);
    BoxCut to_b = edge_in_mesh(a.local, b.local, at_a, at_b, mesh FIELDS);
    BoxCut to_c = edge_in_mesh(a.local, c.local, at_a, at_c, mesh FIELDS);
    BoxCut inside = triangle_in_mesh(a.local, b.local, c.local, at_a, at_b, at_c, mesh FIELDS);
    taken = with_mesh_cut(taken, to_b, a, b, c, collider, recovery FIELDS);
    taken = with_mesh_cut(taken, to_c, a, c, b, collider, recovery FIELDS);
    return with_mesh_cut(taken, inside, a, b, c, collider, recovery FIELDS);
}

/// Returns whether an edge of the cloth shorter than `reach` that ends at a particle can meet a mesh.
SHARED bool near_mesh(vec3 local, vec4 plane, ColliderRecord collider, float reach) {
    vec3 half_extents = vec3(collider.shape.x, collider.shape.y, collider.shape.z);
    precise vec3 beyond = vec3(abs(local.x), abs(local.y), abs(local.z)) - half_extents;
    return beyond.x < reach && beyond.y < reach && beyond.z < reach && abs(plane.w) < reach;
}

/// Returns the displacement of a particle after a collider has moved it, with friction. `surface`: the collider's own
/// displacement there, m, world frame.
SHARED vec3 taken_displacement(vec3 displacement, Taken taken, vec3 surface, ColliderRecord collider, float friction) {
    float squared = ordered_dot(taken.by, taken.by);
    if (!(squared > 0.0f)) return displacement;
    float depth = sqrt(squared);
    precise vec3 direction = taken.by / depth;
    vec3 normal = world_direction(collider, direction);
    precise float pair_friction = friction * collider.shape.w;
    precise vec3 led = displacement + normal * taken.led;
    precise float pressed = depth - taken.led;
    return contact_displacement(led, surface, normal, not_below_zero(pressed), pair_friction).value;
}

#endif
