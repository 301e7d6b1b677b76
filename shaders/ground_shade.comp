// This pass finds which share of the sky's light reaches the floor past what stands above it
// (include/ground_columns.h), with an invocation for each column's foot. The floor sees the sky by the sine of the
// elevation e, so that in a narrow sector what stands between elevations a and b takes sin^2 b - sin^2 a of it. In each
// of 16 sectors the columns that lie along its middle are taken one after the other, farther away those of coarser
// maps. What they take together is summed up in two pieces without gaps, so that the floor sees the sky between a cloth
// above it and a body beside it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/raster_types.h"
#include "shared/simulation_types.h"
#include "include/ground_columns.h"

layout(local_size_x = workgroup_width) in;
layout(set = 0, binding = 0, std430) readonly buffer Columns { uint columns[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Open { float open[]; };

const int sectors = 16, steps = 22;
/// What stands before the sky sends back so much of its light, as fabrics and woods do.
const float sent_back = 0.25;

/// What is taken between two squares of sines: nothing where the first is above the second.
struct Span {
    float low, high;
};
const Span no_span = Span(2.0, -1.0);

bool touch(Span a, Span b) { return a.low <= b.high + 1e-4 && b.low <= a.high + 1e-4; }
Span joined(Span a, Span b) { return Span(min(a.low, b.low), max(a.high, b.high)); }
float size(Span a) { return max(a.high - a.low, 0.0); }

/// Returns what a column takes of which what is in it is at these distances.
Span span_of(int column, float nearer, float farther) {
    uint low = columns[2 * column], high = columns[2 * column + 1];
    float bottom = uintBitsToFloat(low), top = uintBitsToFloat(high);
    if (low == no_height) return no_span;
    float down = bottom * bottom, up = top * top;
    return Span(down / max(down + farther * farther, 1e-12), up > 0.0 ? up / (up + nearer * nearer) : 0.0);
}

/// Returns what is taken in a sector's direction.
float taken(ivec2 foot, vec2 direction) {
    Span first = span_of(foot.y * ground_side + foot.x, 0.0, 0.5), second = no_span;
    float away = 0.0;
    int level = 0;
    for (int step = 0; step < steps; ++step) {
        level = step < 8 ? 0 : step < 14 ? 1 : step < 19 ? 2 : 3;
        float half_width = 0.5 * float(1 << level);
        away += half_width;  // from the farther side of the last to the middle
        away += step == 0 ? 0.5 : 0.0;
        ivec2 place = ivec2(floor(vec2(foot) + 0.5 + away * direction));
        bool within = all(greaterThanEqual(place, ivec2(0))) && all(lessThan(place, ivec2(ground_side)));
        place = clamp(place, ivec2(0), ivec2(ground_side - 1)) >> level;
        // What is somewhere in the column is on average half as wide as it.
        Span next = span_of(ground_level(level) + place.y * (ground_side >> level) + place.x, away - 0.5 * half_width,
                            away + 0.5 * half_width);
        away += half_width;
        if (!within || next.high < next.low) continue;
        bool with_first = first.high < first.low || touch(first, next);
        if (with_first) first = joined(first, next);
        if (!with_first) second = joined(second, next);
    }
    float shared_part = max(min(first.high, second.high) - max(first.low, second.low), 0.0);
    return min(size(first) + size(second) - (size(second) > 0.0 ? shared_part : 0.0), 1.0);
}

void main() {
    int index = int(gl_GlobalInvocationID.x);
    if (index >= ground_side * ground_side) return;
    ivec2 foot = ivec2(index % ground_side, index / ground_side);
    float sum = 0.0;
    for (int sector = 0; sector < sectors; ++sector) {
        float angle = (float(sector) + 0.5) * (6.2831853 / float(sectors));
        sum += taken(foot, vec2(cos(angle), sin(angle)));
    }
    open[index] = 1.0 - (1.0 - sent_back) * sum / float(sectors);
}
