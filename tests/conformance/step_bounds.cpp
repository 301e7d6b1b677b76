#include "step_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace drape::test {

// Vulkan lets a device round a division by 2.5 units and an inverse square root by 2, so a square root, which is one
// over that, by 4.5; sums and products are rounded as by IEEE, since all are `precise`. A bound is what the longest
// chain of such operations adds up to where nothing cancels, roughly, and one unit for the last rounding. In self_limit
// a corner that moves along its plane makes all of its motion or none: where the other side takes all the room it is
// held by a motion towards the plane of 1e-10 m, which is what rounding leaves.
namespace {

std::vector<StepBound> bounds_of_cloths() {
    using enum StepKind;
    using enum Chain;
    return {
        {stiffness, 0, fixed, 0, "a product"},
        {release, 64, fixed, 0, "a root and a division for each of eight springs, added up"},
        {gas_area, 8, fixed, 0, "sums of products, of edges that cancel; no division"},
        {gas_sum, -1, fixed, 0, "it writes no field: what it sums is judged at gas_pressure"},
        {gas_pressure, 64, fixed, 0, "a root and divisions of a sum over all of the cloths"},
        {wind, 20, fixed, 0, "of each quarter two roots and two divisions, its normal used twice; quarters added"},
        {predict, 4, fixed, 0, "the drag's share is one division from 1"},
        {force, 4, fixed, 0, "as predict"},
        {explicit_step, 64, steps, 0, "a root and a division for each of eight springs, added up"},
        {pin, 0, fixed, 0, "sums and products"},
        {bend_targets, 24, fixed, 0, "a root and two divisions, multiplied"},
        {bend_pulls, 0, fixed, 0, "sums and products"},
        {bend, 4, fixed, 0, "a division"},
        {twist, 4, fixed, 0, "a division"},
        {all_twist, 16, fixed, 0, "four times twist"},
        {spring, 12, fixed, 0, "a root, from which the rest length is taken, and two divisions"},
        {all_springs, 96, fixed, 0, "eight times spring"},
        {line, 12, lines, 0, "a root and two divisions for each spring, and each moves all that follow"},
        {nested, 12, lines, 0, "as line, along lines that cross"},
        {torque, 64, fixed, 0, "divisions by masses and drag, added up"},
        {rotate, 64, fixed, 0, "the roots of a matrix by six divisions, of the cloth's size over an arm"},
        {tether, 16, fixed, 0, "a root and a division for each of two tethers"},
        {seam_give, -1, fixed, 0, "it writes no field: what it hands on is judged at seam_take"},
        {seam_take, 4, fixed, 0, "means and sums of what cloths have handed on"},
        {collider_edges, 32, fixed, 0, "divisions of where a triangle cuts an edge; which edge is decided by them"},
        // Contact leaves what rests just as deep as its surface lets it be, so rounding says of any such particle
        // whether the next collision finds it there, and whether it is led out: a tenth of a cloth on a ball.
        {collide, 32, fixed, 100, "roots and divisions of distance and friction; what rests lies on a surface or not"},
        {residual, 16, fixed, 0, "a root and a division, squared"},
        {decide, 0, fixed, 0, "integers; no scene is near its tolerance"},
        {advance, 8, fixed, 0, "a division and a root"},
        {clear_impulses, 0, fixed, 0, "zeros"},
        {body_meet, -1, fixed, 0, "as body_move"},
        {body_move, -1, fixed, 0, "twin_bodies_test compares frames: single steps leave the colliders that follow"},
        {body_strike, -1, fixed, 0, "as body_move"},
        {momentum, 0, fixed, 0, "products, and sums of integers; no scene has what rounds otherwise"},
        {worst_impulses, 0, fixed, 0, "integers, compared by the squares of what they round to"},
    };
}

std::vector<StepBound> bounds_of_contact() {
    using enum StepKind;
    using enum Chain;
    return {
        {self_gather, 8, fixed, 0, "copies, and two divisions of the motion that others are measured against"},
        {self_boxes, 8, fixed, 0, "the motion of self_gather"},
        {self_tree, -1, fixed, 0, "the twin tries all pairs: the list that comes of it is judged at self_pairs"},
        {self_blocks, -1, fixed, 0, "as self_tree"},
        {self_near, -1, fixed, 0, "as self_tree"},
        {self_crossings, 8, fixed, 0, "integers"},
        {self_apart, 8, fixed, 0, "two divisions"},
        {self_primitives, -1, fixed, 0, "as self_tree"},
        {self_pairs, 0, fixed, 50,
         "which pairs are within reach; edges that lie along each other are nearest anywhere"},
        {self_begin, 128, fixed, 0, "three divisions and a root of a distance that is a part of the edges"},
        {self_contact, 128, fixed, 0, "as self_begin"},
        {self_push, 16, fixed, 0, "of the sums, which are integers"},
        {self_impulses, 0, fixed, 0, "as momentum"},
        {self_limit, 128, fixed, 10, "as self_begin; what moves along a plane goes towards it or not by rounding"},
        {self_return, 16, fixed, 0, "products and a division"},
        {self_couples, 64, fixed, 0, "as torque"},
        {self_turn, 64, fixed, 0, "as rotate"},
        {self_sew, 0, fixed, 0, "copies of what the twin's other steps left"},
    };
}

}  // namespace

const std::vector<StepBound>& step_bounds() {
    static const std::vector<StepBound> bounds = [] {
        std::vector<StepBound> all = bounds_of_cloths();
        for (const StepBound& each : bounds_of_contact()) all.push_back(each);
        return all;
    }();
    return bounds;
}

Difference difference_of(const FieldPair& pair, double units) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double scale = pair.least_scale;
    for (const float x : pair.twin) scale = std::max(scale, std::abs(double{x}));
    Difference all{pair.twin.size() + pair.twin_integers.size()};
    const auto add = [&](double apart) {
        all.units = std::max(all.units, apart);
        if (apart > units) ++all.beyond;
    };
    for (std::size_t k = 0; k < pair.twin.size(); ++k) {
        if (pair.device[k] == pair.twin[k]) continue;
        const double apart = std::abs(double{pair.device[k]} - double{pair.twin[k]}) / scale * 0x1p23;
        add(std::isnan(apart) ? infinity : apart);
    }
    for (std::size_t k = 0; k < pair.twin_integers.size(); ++k)
        if (pair.device_integers[k] != pair.twin_integers[k]) add(infinity);
    return all;
}

}  // namespace drape::test
