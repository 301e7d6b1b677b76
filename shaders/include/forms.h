// Finds the point of a mesh that deforms nearest to a sample of its field.
#ifndef DRAPE_FORMS_H
#define DRAPE_FORMS_H

#include "include/vector.h"
#include "shared/form_types.h"

// The includer defines the lists; in GLSL they are buffers.
#ifdef __cplusplus
struct FormTables {
    const FormNode* nodes;
    const vec4* corners;
    const uint *guesses, *sides;
};
#define WITH_FORMS , const FormTables& forms
#define FORMS , forms
#define FORM_NODE(place) forms.nodes[place]
#define FORM_CORNER(place) forms.corners[place]
#define FORM_GUESS(place) forms.guesses[place]
#define FORM_SIDES(place) forms.sides[place]
#else
#define WITH_FORMS
#define FORMS
#define FORM_NODE(place) form_nodes[place]
#define FORM_CORNER(place) form_corners[place]
#define FORM_GUESS(place) form_guesses[place]
#define FORM_SIDES(place) form_sides[place]
#endif

/// The point of a triangle nearest to another point: the shares of its second and third corner, and the square of the
/// distance, m^2.
struct TriangleFoot {
    float second, third, squared;
};

SHARED vec3 difference_of(vec3 a, vec3 b) {
    precise vec3 difference = a - b;
    return difference;
}

SHARED TriangleFoot triangle_foot_at(vec3 from_first, vec3 ab, vec3 ac, float second, float third) {
    precise vec3 off = from_first - ab * second - ac * third;
    return TriangleFoot(second, third, ordered_dot(off, off));
}

/// The region of the plane over which the point lies decides (Ericson, "Real-Time Collision Detection", 5.1.5).
SHARED TriangleFoot triangle_foot(vec3 point, vec3 a, vec3 b, vec3 c) {
    vec3 ab = difference_of(b, a), ac = difference_of(c, a), ap = difference_of(point, a);
    float d1 = ordered_dot(ab, ap), d2 = ordered_dot(ac, ap);
    if (d1 <= 0.0f && d2 <= 0.0f) return triangle_foot_at(ap, ab, ac, 0.0f, 0.0f);
    vec3 bp = difference_of(point, b);
    float d3 = ordered_dot(ab, bp), d4 = ordered_dot(ac, bp);
    if (d3 >= 0.0f && d4 <= d3) return triangle_foot_at(ap, ab, ac, 1.0f, 0.0f);
    precise float vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0f && d1 >= 0.0f && d3 <= 0.0f) {
        precise float share = d1 / (d1 - d3);
        return triangle_foot_at(ap, ab, ac, share, 0.0f);
    }
    vec3 cp = difference_of(point, c);
    float d5 = ordered_dot(ab, cp), d6 = ordered_dot(ac, cp);
    if (d6 >= 0.0f && d5 <= d6) return triangle_foot_at(ap, ab, ac, 0.0f, 1.0f);
    precise float vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0f && d2 >= 0.0f && d6 <= 0.0f) {
        precise float share = d2 / (d2 - d6);
        return triangle_foot_at(ap, ab, ac, 0.0f, share);
    }
    precise float va = d3 * d6 - d5 * d4;
    precise float beyond_b = d4 - d3;
    precise float beyond_c = d5 - d6;
    if (va <= 0.0f && beyond_b >= 0.0f && beyond_c >= 0.0f) {
        precise float share = beyond_b / (beyond_b + beyond_c);
        precise float rest = 1.0f - share;
        return triangle_foot_at(ap, ab, ac, rest, share);
    }
    precise float all = va + vb + vc;
    if (!(all > 0.0f))
        return triangle_foot_at(ap, ab, ac, 0.0f, 0.0f);  // it has no area, and its edges were not nearer
    precise float second = vb / all;
    precise float third = vc / all;
    return triangle_foot_at(ap, ab, ac, second, third);
}

SHARED vec3 form_corner(int corner WITH_FORMS) {
    vec4 at = FORM_CORNER(corner);
    return vec3(at.x, at.y, at.z);
}

SHARED TriangleFoot form_foot(vec3 point, int first_corner, uint triangle WITH_FORMS) {
    int corner = first_corner + 3 * int(triangle);
    return triangle_foot(point, form_corner(corner FORMS), form_corner(corner + 1 FORMS),
                         form_corner(corner + 2 FORMS));
}

/// Returns the square of the distance from a point to a box.
SHARED float box_gap(vec3 point, FormNode box) {
    precise vec3 below = vec3(box.lower.x, box.lower.y, box.lower.z) - point;
    precise vec3 above = point - vec3(box.upper.x, box.upper.y, box.upper.z);
    vec3 off = vec3(below.x > above.x ? below.x : above.x, below.y > above.y ? below.y : above.y,
                    below.z > above.z ? below.z : above.z);
    off = vec3(off.x > 0.0f ? off.x : 0.0f, off.y > 0.0f ? off.y : 0.0f, off.z > 0.0f ? off.z : 0.0f);
    return ordered_dot(off, off);
}

/// Returns whether nothing in a box can be nearer than the nearest point so far, or not by enough to matter.
SHARED bool is_beyond(float gap, float found, float exact) {
    precise float slack = gap * (found > exact ? 1.0404f : 0.99999f);
    return !(slack < found);
}

struct FormFoot {
    TriangleFoot foot;
    uint triangle;
};

SHARED FormFoot nearest_foot(vec3 point, FormPush push, int form, uint guess WITH_FORMS) {
    int corner = push.first.y + 3 * form * push.count.y, node = push.first.x + form * push.count.x;
    uint first = guess & ~guess_does;
    FormFoot nearest = FormFoot(form_foot(point, corner, first FORMS), first);
    int at = first == guess ? 0 : push.count.x;
    while (at < push.count.x) {
        FormNode box = FORM_NODE(node + at);
        bool beyond = is_beyond(box_gap(point, box), nearest.foot.squared, push.exact);
        if (!beyond && box.triangles.x != no_triangle) {
            for (int k = 0; k < most_leaf_triangles; ++k) {
                uint triangle = k == 0   ? box.triangles.x
                                : k == 1 ? box.triangles.y
                                : k == 2 ? box.triangles.z
                                         : box.triangles.w;
                if (triangle != no_triangle) {
                    TriangleFoot foot = form_foot(point, corner, triangle FORMS);
                    if (foot.squared < nearest.foot.squared) nearest = FormFoot(foot, triangle);
                }
            }
        }
        at = beyond ? int(box.links.x) : at + 1;
    }
    return nearest;
}

/// Returns how far the foot point moves from the form at the frame's start to that at its end, m.
SHARED vec3 foot_way(FormFoot nearest, FormPush push WITH_FORMS) {
    int before = push.first.y + 3 * int(nearest.triangle), after = before + 3 * push.count.y;
    vec3 a = difference_of(form_corner(after FORMS), form_corner(before FORMS));
    vec3 b = difference_of(form_corner(after + 1 FORMS), form_corner(before + 1 FORMS));
    vec3 c = difference_of(form_corner(after + 2 FORMS), form_corner(before + 2 FORMS));
    precise float first = 1.0f - nearest.foot.second - nearest.foot.third;
    precise vec3 way = a * first + b * nearest.foot.second + c * nearest.foot.third;
    return way;
}

/// A sample: the distances to both forms, negative inside, and how far the surface near it moves during the frame, m.
struct FormSample {
    float begin, end;
    vec3 way;
};

SHARED float form_distance(FormFoot nearest, FormPush push, int form, int number WITH_FORMS) {
    uint word = FORM_SIDES(push.first.w + form * push.count.w + number / 32);
    bool inside = (word >> uint(number % 32) & 1u) != 0u;
    precise float distance = sqrt(nearest.foot.squared) - push.half_shell;
    return inside ? -distance : distance;
}

/// The surface's motion is the mean of that of the point nearest at the frame's start and of the one nearest at its
/// end: on a body that turns, this also gives the middle direction between the two.
SHARED FormSample form_sample(FormPush push, int x, int y, int z WITH_FORMS) {
    precise vec3 point =
        vec3(push.lower.x, push.lower.y, push.lower.z) + vec3(float(x), float(y), float(z)) * push.lower.w;
    int number = (z * push.size.y + y) * push.size.x + x;
    int across = (push.size.x + guess_block - 1) / guess_block, up = (push.size.y + guess_block - 1) / guess_block;
    int guess = push.first.z + (z / guess_block * up + y / guess_block) * across + x / guess_block;
    FormFoot begin = nearest_foot(point, push, 0, FORM_GUESS(guess) FORMS);
    FormFoot end = nearest_foot(point, push, 1, FORM_GUESS(guess + push.count.z) FORMS);
    precise vec3 way = (foot_way(begin, push FORMS) + foot_way(end, push FORMS)) * 0.5f;
    return FormSample(form_distance(begin, push, 0, number FORMS), form_distance(end, push, 1, number FORMS), way);
}

#endif
