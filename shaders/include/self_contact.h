// Contact of cloths with themselves and each other (docs/physics.md 5). A pair is a particle and a triangle, or two
// edges, that share no corner: when surfaces come to cross, such a pair touches first. For every pair that a substep
// may bring together, a plane between the two primitives is computed, and no corner moves farther than its share of the
// distance to that plane. So nothing crosses, whatever motion the solver computed (Newton's planar truncation; the
// bound per particle is that of Chen et al. 2025, "Offset Geometric Contact"). Before that, pairs nearer than the
// thickness are pushed apart, with friction. Motions are measured relative to a motion that all particles have in
// common, which changes no distance.
#ifndef DRAPE_SELF_CONTACT_H
#define DRAPE_SELF_CONTACT_H

#include "include/self_elements.h"
#include "include/self_gap.h"
#include "shared/self_contact_types.h"

/// The shares of a pair's distance that remain on each side of its plane, for a free particle and for a held one, whose
/// motion contact cannot change.
const float self_gap_kept = 0.25f, self_held_kept = 0.025f;
/// A correction is at most the first share of the thickness; the list of pairs allows for the second.
const float self_correction_share = 0.24f, self_listed_share = 0.5f;
/// Where truncation would leave a particle behind by more than this share of the spacing, its cloth goes on as a whole.
const float self_lag_share = 0.05f;
/// A search that visits more nodes is given up: the default device would silently break off a loop of about so many
/// rounds.
const int self_visit_limit = 60000;
/// The common motion is the mean over a lattice of particles with this many along a side.
const int self_samples = 6, self_cloth_samples = self_samples * self_samples;

/// Returns whether a particle that makes a share of its motion stays far behind (docs/contact.md, "Truncation").
SHARED bool self_stays_behind(vec3 motion, float share, vec2 spacing) {
    float least = spacing.y < spacing.x ? spacing.y : spacing.x;
    precise float reach = least * self_lag_share;
    precise float lacking = 1.0f - share;
    precise float lag = ordered_dot(motion, motion) * (lacking * lacking);
    precise float most = reach * reach;
    return lag > most;
}

/// Returns the mean thickness of two cloths; for a cloth and itself it is exact.
SHARED float self_mean_thickness(SelfCloth one, SelfCloth other) {
    precise float mean = (one.thickness + other.thickness) * 0.5f;
    return mean;
}

SHARED bool self_same_cloth(SelfCloth one, SelfCloth other) {
    return one.first.x == other.first.x && one.first.y == other.first.y;
}

/// Returns the inverse masses of a pair's corners, all in the first cloth's units.
SHARED vec4 self_corner_masses(bool edges, SelfCloth one, SelfCloth other, vec4 relative) {
    precise vec4 masses = vec4(relative.x * one.lightness, relative.y * (edges ? one.lightness : other.lightness),
                               relative.z * other.lightness, relative.w * other.lightness);
    return masses;
}

/// Returns the thickness that two primitives keep where they are nearest to each other: the mean of their thicknesses
/// there. `corners`: the particles' thicknesses; `weights`: those of their gap.
SHARED float self_thickness_there(vec4 weights, vec4 corners) {
    precise float sum = ((abs(weights.x) * corners.x + abs(weights.y) * corners.y) + abs(weights.z) * corners.z) +
                        abs(weights.w) * corners.w;
    precise float mean = sum * 0.5f;
    return mean;
}

/// Returns the friction where the two are nearest. `corners`: the square roots of the particles' coefficients.
SHARED float self_friction_there(bool edges, vec4 weights, vec4 corners) {
    precise float a = abs(weights.x) * corners.x;
    precise float b = abs(weights.y) * corners.y;
    precise float rest = abs(weights.z) * corners.z + abs(weights.w) * corners.w;
    precise float of_edges = (a + b) * rest;
    precise float of_point = a * (b + rest);
    return edges ? of_edges : of_point;
}

SHARED float self_pair_friction(SelfCloth one, SelfCloth other) {
    precise float mean = sqrt(one.friction * other.friction);
    return self_same_cloth(one, other) ? one.friction : mean;
}

/// Returns the thickness that a pair keeps, where `thickness` is the mean of its two sides. Primitives of one cloth
/// that are nearer than two thicknesses in the flat cloth keep half of that distance, so that contact does not stiffen
/// a cloth that is compressed in its plane. `a` to `d`: columns and rows of the particles; `one`, `other`: the cloths
/// of the first and of the last.
SHARED float self_pair_thickness(float thickness, SelfCloth one, SelfCloth other, bool edges, ivec2 a, ivec2 b, ivec2 c,
                                 ivec2 d) {
    int columns = b.x - a.x, rows = b.y - a.y;
    if (edges) {
        columns = c.x - a.x;
        rows = c.y - a.y;
    }
    bool far = columns > 4 || columns < -4 || rows > 4 || rows < -4;
    precise vec3 liesa = vec3(float(a.x) * one.spacing.x, float(a.y) * one.spacing.y, 0.0f);
    precise vec3 liesb = vec3(float(b.x) * one.spacing.x, float(b.y) * one.spacing.y, 0.0f);
    precise vec3 liesc = vec3(float(c.x) * one.spacing.x, float(c.y) * one.spacing.y, 0.0f);
    precise vec3 liesd = vec3(float(d.x) * one.spacing.x, float(d.y) * one.spacing.y, 0.0f);
    SelfCorners x = self_relative(SelfCorners(liesa, liesb, liesc, liesd));
    vec3 across = self_sum(self_weights(edges, x), x);
    precise float half_distance = sqrt(ordered_dot(across, across)) * 0.5f;
    float least = self_least(thickness, half_distance);
    return far || !self_same_cloth(one, other) ? thickness : least;
}

/// Returns the thickness of a pair with a corner at a seam: what the other side of the seam has there is no farther in
/// the flat cloth than the nearest primitives of a grid, and keeps half of that at most.
SHARED float self_thickness_at_seam(float thickness, SelfCloth one, SelfCloth other) {
    precise float half_flat = self_least(one.least_flat, other.least_flat) * 0.5f;
    return self_least(thickness, half_flat);
}

/// Returns a bound on how much nearer a pair's corners come along its normal in a substep, before contact corrects it,
/// whatever part of their motions they make.
SHARED float self_approach(bool edges, SelfGap gap, SelfCorners motions) {
    float a = ordered_dot(gap.normal, motions.a), b = ordered_dot(gap.normal, motions.b),
          c = ordered_dot(gap.normal, motions.c), d = ordered_dot(gap.normal, motions.d);
    float first = edges ? self_largest(a, b) : a;
    float second = edges ? self_least(c, d) : self_least(b, self_least(c, d));
    precise float approach = (self_largest(first, 0.0f) - self_least(second, 0.0f)) * 1.00001f;
    return approach;
}

/// Returns whether a pair is listed: it may come nearer than its thickness, or may touch with the motion that contact
/// may add to each corner. `thickness`: the mean of the two cloths'.
SHARED bool self_listed_pair(bool edges, SelfGap gap, SelfCorners motions, float pair_thickness, float thickness) {
    precise float slack = thickness * self_listed_share;
    precise float listing =
        (self_largest(pair_thickness, slack) + self_approach(edges, gap, motions)) + gap.doubt * 2.0f;
    return gap.apart < listing;
}

/// Returns the largest gap between two boxes along an axis, a lower bound of their distance.
SHARED float self_box_distance(SelfBox a, SelfBox b) {
    precise float x = a.lower.x - b.upper.x;
    precise float y = a.lower.y - b.upper.y;
    precise float z = a.lower.z - b.upper.z;
    precise float back_x = b.lower.x - a.upper.x;
    precise float back_y = b.lower.y - a.upper.y;
    precise float back_z = b.lower.z - a.upper.z;
    return self_largest(self_largest(self_largest(x, back_x), self_largest(y, back_y)), self_largest(z, back_z));
}

/// Returns the distance below which primitives may be listed in this substep; their boxes contain all of their motions.
SHARED float self_reach(SelfBox a, SelfContactPush push, float thickness) {
    float doubt = self_doubt(self_largest(self_largest_coordinate(vec3(a.lower.x, a.lower.y, a.lower.z)),
                                          self_largest_coordinate(vec3(a.upper.x, a.upper.y, a.upper.z))));
    precise float reach = (thickness + push.least) + doubt * 4.0f;
    return reach;
}

/// Returns whether primitives in two boxes may be listed. `thickness`: the mean of their cloths'.
SHARED bool self_boxes_meet(SelfBox a, SelfBox b, SelfContactPush push, float thickness) {
    return self_box_distance(a, b) <= self_reach(a, push, thickness);
}

/// A search looks this many substeps ahead, as if each cell kept its velocity relative to the mean motion.
const float self_substeps_ahead = 4.0f;

/// Returns the box with which a cell is searched for. The result remains valid while the cell stays inside, in later
/// substeps too.
SHARED SelfBox self_kept_box(SelfBox box, vec3 motion, vec3 mean, float margin) {
    precise vec3 on = (motion - mean) * self_substeps_ahead;
    precise float half_margin = margin * 0.5f;
    vec3 room = vec3(half_margin, half_margin, half_margin);
    vec3 down = vec3(self_least(on.x, 0.0f), self_least(on.y, 0.0f), self_least(on.z, 0.0f));
    vec3 up = vec3(self_largest(on.x, 0.0f), self_largest(on.y, 0.0f), self_largest(on.z, 0.0f));
    precise vec3 kept_lower = vec3(box.lower.x, box.lower.y, box.lower.z) + (down - room);
    precise vec3 kept_upper = vec3(box.upper.x, box.upper.y, box.upper.z) + (up + room);
    return SelfBox(vec4(kept_lower.x, kept_lower.y, kept_lower.z, 0.0f),
                   vec4(kept_upper.x, kept_upper.y, kept_upper.z, 0.0f));
}

SHARED vec3 self_travelled(vec3 travel, vec3 mean) {
    precise vec3 sum = travel + mean;
    return sum;
}

SHARED ivec2 self_sample(ivec2 grid, int k) {
    int column = k % self_samples, row = k / self_samples;
    return ivec2((2 * column + 1) * (grid.x - 1) / (2 * self_samples),
                 (2 * row + 1) * (grid.y - 1) / (2 * self_samples));
}

SHARED vec3 self_mean(vec3 sum, int cloth_count) {
    precise vec3 mean = sum / float(self_cloth_samples * cloth_count);
    return mean;
}

/// Returns which part of a mean motion a particle makes along it.
SHARED float self_part_made(vec3 motion, vec3 mean) {
    precise float part = self_ratio(ordered_dot(motion, mean), ordered_dot(mean, mean));
    return part;
}

/// Returns the common motion: the smallest part of the mean that any particle makes, so that cloth that rests on a
/// collider is not carried into it by cloth that falls on it.
SHARED vec3 self_common_motion(vec3 mean, float least_part) {
    precise vec3 made = mean * self_limited(least_part);
    return made;
}

/// Returns whether two cells are the same or neighbours, and therefore of one cloth; such cells are judged by how flat
/// the cloth is around them.
SHARED bool self_neighbours(ivec2 a, ivec2 b) {
    int columns = b.x - a.x, rows = b.y - a.y;
    return columns >= -1 && columns <= 1 && rows >= -1 && rows <= 1;
}

/// Returns pair k of those cells, at most two columns and rows apart, for which a cell is responsible, relative to it:
/// xy is the cell with the lower place, zw the other; neighbours come first. Each such pair of a grid belongs to
/// exactly one cell.
const int self_neighbour_pairs = 5, self_close_pairs = 13;
SHARED ivec4 self_close_pair(int k) {
    // Each pair has two bits for each of the four numbers, from the lowest bits on.
    uint four = k < 4 ? 0x50401000u : k < 8 ? 0x42602041u : k < 12 ? 0x908082a0u : 0x81u;
    uint pair = four >> uint(8 * (k & 3));
    return ivec4(int(pair & 3u), int((pair >> 2) & 3u), int((pair >> 4) & 3u), int((pair >> 6) & 3u));
}

/// Returns whether two cells of a cloth are at most two columns and rows apart.
SHARED bool self_close(ivec2 a, ivec2 b) {
    int columns = b.x - a.x, rows = b.y - a.y;
    return columns >= -2 && columns <= 2 && rows >= -2 && rows <= 2;
}

/// The particles of a patch of 2 x 2 cells.
struct SelfPatch {
    vec3 middle, left, right, up, down, up_left, up_right, down_left, down_right;
};

SHARED float self_squared(vec3 x) { return ordered_dot(x, x); }

/// Returns the square of the part of a motion in the plane with this normal.
SHARED float self_within(vec3 motion, vec3 normal) {
    precise float across = ordered_dot(motion, normal);
    precise float within = ordered_dot(motion, motion) - across * across;
    return within;
}

SHARED float self_moves_within(SelfPatch motions, vec3 normal) {
    float beside = self_largest(self_largest(self_within(motions.left, normal), self_within(motions.right, normal)),
                                self_largest(self_within(motions.up, normal), self_within(motions.down, normal)));
    float corners =
        self_largest(self_largest(self_within(motions.up_left, normal), self_within(motions.up_right, normal)),
                     self_largest(self_within(motions.down_left, normal), self_within(motions.down_right, normal)));
    return self_largest(self_within(motions.middle, normal), self_largest(beside, corners));
}

/// Returns the square of the largest distance of a patch's particles from a linear map.
SHARED float self_off(SelfPatch x, vec3 along, vec3 across) {
    precise vec3 bent = (x.right + x.left) * 0.5f - x.middle;
    precise vec3 bent_across = (x.down + x.up) * 0.5f - x.middle;
    precise vec3 up_left = ((x.up_left - x.middle) + along) + across;
    precise vec3 up_right = ((x.up_right - x.middle) - along) + across;
    precise vec3 down_left = ((x.down_left - x.middle) + along) - across;
    precise vec3 down_right = ((x.down_right - x.middle) - along) - across;
    float off = self_largest(self_squared(bent), self_squared(bent_across));
    off = self_largest(off, self_largest(self_squared(up_left), self_squared(up_right)));
    return self_largest(off, self_largest(self_squared(down_left), self_squared(down_right)));
}

/// Returns the smaller singular value of a map with these columns, rounded down.
SHARED float self_singular_value(vec3 first, vec3 second) {
    precise float mean = (self_squared(first) + self_squared(second)) * 0.5f;
    precise float half_difference = (self_squared(first) - self_squared(second)) * 0.5f;
    float mixed = ordered_dot(first, second);
    precise float spread = sqrt(half_difference * half_difference + mixed * mixed);
    precise float squared = mean - spread;
    precise float singular = sqrt(self_largest(squared, 0.0f)) * 0.999f;
    return singular;
}

/// Returns whether no primitive of a patch comes near another one with which it shares no corner, whatever part of
/// their motions the particles make. The cloth there is a linear map, except for the distance of its particles from the
/// map, at most `off`, and their motion in its plane, at most `within`: two points that are `flat` apart at rest are at
/// least s flat - 2 off - 2 within apart, where s is the map's smaller singular value. Motion perpendicular to the
/// plane brings none nearer.
SHARED bool self_patch_lies_flat(SelfContactPush push, SelfCloth cloth, SelfPatch x, SelfPatch motions) {
    precise vec3 along = (x.right - x.left) * 0.5f;
    precise vec3 across = (x.down - x.up) * 0.5f;
    precise vec3 first = along * reciprocal(cloth.spacing.x);
    precise vec3 second = across * reciprocal(cloth.spacing.y);
    float singular = self_singular_value(first, second);
    vec3 normal = ordered_cross(first, second);
    precise float area = sqrt(self_squared(normal));
    precise vec3 unit = normal * reciprocal(area);
    float doubt = self_doubt(self_largest(
        self_largest(self_largest_coordinate(x.middle), self_largest_coordinate(x.up_left)),
        self_largest(self_largest_coordinate(x.down_right),
                     self_largest(self_largest_coordinate(x.up_right), self_largest_coordinate(x.down_left)))));
    precise float within = sqrt(self_largest(self_moves_within(motions, unit), 0.0f));
    precise float slack = cloth.thickness * self_listed_share;
    precise float half_flat = cloth.least_flat * 0.5f;
    float listed = self_largest(self_least(cloth.thickness, half_flat), slack);
    precise float distance = singular * cloth.least_flat - sqrt(self_off(x, along, across)) * 2.001f;
    precise float needed = ((listed + within * 2.002f) + doubt * 4.0f) + push.least;
    // Pairs farther apart in the flat cloth keep a larger distance, but at most half of theirs.
    return singular > 0.5f && distance > needed;
}

/// Returns the box of a place without cloth, which is near nothing.
SHARED SelfBox self_no_box() {
    return SelfBox(vec4(1.0e30f, 1.0e30f, 1.0e30f, 0.0f), vec4(-1.0e30f, -1.0e30f, -1.0e30f, 0.0f));
}

SHARED SelfBox self_joined(SelfBox a, SelfBox b) {
    return SelfBox(vec4(self_least(a.lower.x, b.lower.x), self_least(a.lower.y, b.lower.y),
                        self_least(a.lower.z, b.lower.z), 0.0f),
                   vec4(self_largest(a.upper.x, b.upper.x), self_largest(a.upper.y, b.upper.y),
                        self_largest(a.upper.z, b.upper.z), 0.0f));
}

/// Returns the box of a particle's motion relative to the common one.
SHARED SelfBox self_point_box(vec3 at, vec3 motion) {
    precise vec3 end = at + motion;
    return SelfBox(vec4(self_least(at.x, end.x), self_least(at.y, end.y), self_least(at.z, end.z), 0.0f),
                   vec4(self_largest(at.x, end.x), self_largest(at.y, end.y), self_largest(at.z, end.z), 0.0f));
}

/// Returns a displacement relative to the common motion.
SHARED vec3 self_relative_motion(vec3 displacement, vec3 carried) {
    precise vec3 motion = displacement - carried;
    return motion;
}

/// Returns how far (m) contact, and colliders after it, may move a particle away from the motion that it had before
/// them, or from any part of that motion; the list of pairs allows for this.
SHARED float self_limit(float thickness) {
    precise float limit = thickness * self_correction_share;
    return limit;
}

/// Returns the part of the motion before contact, relative to the common one, that is nearest to a displacement.
SHARED vec3 self_part_kept(vec3 displacement, vec3 before, vec3 carried) {
    vec3 wanted = self_relative_motion(before, carried), motion = self_relative_motion(displacement, carried);
    float part = self_limited(self_ratio(ordered_dot(motion, wanted), ordered_dot(wanted, wanted)));
    precise vec3 kept = carried + wanted * part;
    return kept;
}

SHARED bool self_exceeds(vec3 displacement, vec3 nearest, float thickness) {
    precise vec3 change = displacement - nearest;
    precise float length = sqrt(ordered_dot(change, change));
    precise float limit = self_limit(thickness) * 1.00001f;
    return length > limit;
}

/// Returns the displacement after contact and colliders: the part of the earlier displacement that they kept, changed
/// by no more than the limit. Contact can thus stop a particle, however far the solver moves it, and let it slide.
SHARED vec3 self_bounded(vec3 displacement, vec3 before, vec3 carried, float thickness) {
    vec3 kept = self_part_kept(displacement, before, carried);
    vec3 nearest = self_exceeds(displacement, before, thickness) ? kept : before;
    precise vec3 change = displacement - nearest;
    precise float length = sqrt(ordered_dot(change, change));
    precise float share = self_limit(thickness) / length;
    precise vec3 bounded = nearest + change * share;
    return self_exceeds(displacement, nearest, thickness) ? bounded : displacement;
}

/// Returns the heights (m) of a pair's corners along its normal when each makes `shares` of its motion `along` it.
SHARED vec4 self_ends(SelfGap gap, vec4 along, vec4 shares) {
    precise vec4 ends = vec4(gap.height.x + along.x * shares.x, gap.height.y + along.y * shares.y,
                             gap.height.z + along.z * shares.z, gap.height.w + along.w * shares.w);
    return ends;
}

/// Returns the place, m along the normal, of the plane between the two when the corners are at `ends`. Each side keeps
/// its share of the initial distance; the rest is divided in proportion to what each side wants, so that a layer can
/// follow one that moves away from it. `wants`: the motion along the normal that the corners still lack.
SHARED float self_middle(bool edges, float apart, vec4 ends, vec4 wants) {
    float below = edges ? self_largest(ends.x, ends.y) : ends.x;
    float above = edges ? self_least(ends.z, ends.w) : self_least(ends.y, self_least(ends.z, ends.w));
    float up = self_largest(edges ? self_largest(wants.x, wants.y) : wants.x, 0.0f);
    float least_up = edges ? self_least(wants.z, wants.w) : self_least(wants.y, self_least(wants.z, wants.w));
    float down = self_largest(-least_up, 0.0f);
    precise float all = up + down;
    precise float gap = above - below;
    precise float half_gap = gap * 0.5f;
    precise float quarter = apart * self_gap_kept;
    float kept = self_least(half_gap, quarter);
    precise float rest = gap - 2.0f * kept;
    float part = all > 0.0f ? self_ratio(up, all) : 0.5f;
    precise float middle = below + kept + part * rest;
    return middle;
}

/// Returns the share of its motion that a pair allows a corner, at least `share`, which it already makes and which took
/// it to `end`. `side`: 1 where it lies before the plane, -1 beyond. The pair stays apart by what the two sides keep,
/// for all shares of the corners between the given and the returned ones, since both ends of every motion are on their
/// side of a plane that moves evenly.
SHARED float self_share(SelfGap gap, float middle, float end, float side, float along, float share, bool held,
                        float least) {
    float doubt = self_largest(least, gap.doubt);
    precise float nearly = doubt * 0.25f;
    precise float kept = gap.apart * (held ? self_held_kept : self_gap_kept);
    precise float room = (middle - end) * side - kept;
    float allowed = gap.apart > doubt ? self_largest(room, 0.0f) : 0.0f;
    precise float left = 1.0f - share;
    precise float wanted = left * (along * side);
    precise float part = share + left * (allowed / wanted);
    float made = wanted > allowed ? self_limited(part) : 1.0f;
    float still = along != 0.0f ? share : 1.0f;
    return gap.apart > nearly ? made : still;
}

/// Returns the motion along the normal that corners still lack.
SHARED vec4 self_wants(vec4 along, vec4 shares) {
    precise vec4 wants = vec4(along.x - along.x * shares.x, along.y - along.y * shares.y, along.z - along.z * shares.z,
                              along.w - along.w * shares.w);
    return wants;
}

/// Returns whether two primitives touch; then there is no plane between them, and nothing is proved about them.
SHARED bool self_touch(SelfGap gap) { return !(gap.distance > 1.0e-12f); }

SHARED vec3 self_truncated(vec3 carried, vec3 motion, float share) {
    precise vec3 truncated = carried + motion * share;
    return truncated;
}

/// Returns how many entries a list contains.
SHARED int self_listed(uint count, int room) { return count < uint(room) ? int(count) : room; }

/// Returns how many entries a list contains when another list grows towards it from the end of the same memory. It is 0
/// if they have overwritten each other, in a substep that is done again or given up (self_list_use).
SHARED int self_both_listed(uint count, uint other, int room) { return count + other <= uint(room) ? int(count) : 0; }

/// Returns the fourth axis for a pair of cells, the normal of the first: the layers of a stack that lies obliquely are
/// separated along it and no other axis. It is zero, an axis that separates nothing, where the cell does not exist or
/// has no area.
SHARED vec3 self_cell_normal(bool exists, vec3 first, vec3 right, vec3 below, vec3 last) {
    precise vec3 down = last - first;
    precise vec3 up = right - below;
    vec3 across = ordered_cross(down, up);
    precise float area = sqrt(self_squared(across));
    precise vec3 unit = across * reciprocal(area);
    return exists && area > 1.0e-15f ? unit : vec3(0.0f, 0.0f, 0.0f);
}

/// Returns the box of a particle's motion, with the extent along `axis`, the fourth one, in w.
SHARED SelfBox self_slab(vec3 at, vec3 motion, vec3 axis) {
    precise vec3 end = at + motion;
    float along = ordered_dot(axis, at), then = ordered_dot(axis, end);
    return SelfBox(
        vec4(self_least(at.x, end.x), self_least(at.y, end.y), self_least(at.z, end.z), self_least(along, then)),
        vec4(self_largest(at.x, end.x), self_largest(at.y, end.y), self_largest(at.z, end.z),
             self_largest(along, then)));
}

SHARED SelfBox self_slabs_joined(SelfBox a, SelfBox b) {
    return SelfBox(vec4(self_least(a.lower.x, b.lower.x), self_least(a.lower.y, b.lower.y),
                        self_least(a.lower.z, b.lower.z), self_least(a.lower.w, b.lower.w)),
                   vec4(self_largest(a.upper.x, b.upper.x), self_largest(a.upper.y, b.upper.y),
                        self_largest(a.upper.z, b.upper.z), self_largest(a.upper.w, b.upper.w)));
}

/// Returns whether two primitives in these boxes of four axes may be listed. A pair whose boxes are farther apart
/// cannot come as near as its thickness, whatever part of their motions its corners make.
SHARED bool self_primitives_meet(SelfBox a, SelfBox b, SelfContactPush push, float thickness) {
    precise float ahead = b.lower.w - a.upper.w;
    precise float behind = a.lower.w - b.upper.w;
    float apart = self_largest(self_box_distance(a, b), self_largest(ahead, behind));
    return apart <= self_reach(a, push, thickness);
}

/// Returns the numbers of boxes along columns and rows in a level of the tree.
SHARED ivec2 self_tree_size(ivec2 grid, int level) {
    return ivec2(((grid.x - 1) >> level) + 1, ((grid.y - 1) >> level) + 1);
}
SHARED int self_tree_count(ivec2 grid, int level) {
    ivec2 size = self_tree_size(grid, level);
    return size.x * size.y;
}

#endif
