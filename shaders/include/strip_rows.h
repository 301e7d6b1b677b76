// Shared code of kernels that go down the rows of a strip of columns (spring_stream.comp, twist_stream.comp). A
// subgroup has a strip; an invocation has `columns` of its columns, an even number, and also a ghost, a copy of the
// first column of the invocation on the right. Neighbouring strips overlap by `strip_halo` columns at either end, which
// other strips store. The includer has the images `position` and `displacement_in`, `displacement_out` and `push.grid`.
#include "include/row_bands.h"
const int ghost = columns;

struct Particle {
    vec3 position;
    float weight;
    vec3 displacement;
    float mark;  // the mark beside the displacement (verlet.h)
};

int first_column() {
    return int(gl_WorkGroupID.x) * (strip_width - 2 * strip_halo) + int(gl_SubgroupInvocationID) * columns;
}

/// Returns the value of the invocation on the right; a strip's last invocation gets its own value, which is not used.
vec3 from_right(vec3 value) {
    int lane = int(gl_SubgroupInvocationID);
    return subgroupShuffle(value, uint(lane + 1 < stream_lanes ? lane + 1 : lane));
}

/// Outside the grid, returns a copy of the particle on its border.
Particle load(int x, int y) {
    ivec2 texel = ivec2(x < push.grid.x ? x : push.grid.x - 1, y < push.grid.y ? y : push.grid.y - 1);
    vec4 start = LOAD(position, texel), moved = LOAD(displacement_in, texel);
    return Particle(start.xyz, dragged_weight(start.w, moved.w), moved.xyz, moved.w);
}

void load_row(int y, out Particle row[columns + 1]) {
    for (int c = 0; c < columns; ++c) row[c] = load(first_column() + c, y);
    int lane = int(gl_SubgroupInvocationID);
    row[ghost].position = from_right(row[0].position);
    row[ghost].weight = subgroupShuffle(row[0].weight, uint(lane + 1 < stream_lanes ? lane + 1 : lane));
    row[ghost].displacement = row[0].displacement;
    row[ghost].mark = 0.0f;
}

/// Returns whether this strip stores column c of the invocation; other strips store this one's halo.
bool is_own(int c) {
    int within = int(gl_SubgroupInvocationID) * columns + c;
    int first = gl_WorkGroupID.x == 0 ? 0 : strip_halo;
    int end = gl_WorkGroupID.x + 1 == gl_NumWorkGroups.x ? strip_width : strip_width - strip_halo;
    return within >= first && within < end;
}

void store_row(RowBand band, int y, Particle row[columns + 1]) {
    for (int c = 0; c < columns; ++c) {
        ivec2 texel = ivec2(first_column() + c, y);
        if (!is_own(c) || texel.x >= push.grid.x || !is_of(band, y)) continue;
        STORE_VECTOR(displacement_out, texel, vec4(row[c].displacement, row[c].mark));
    }
}

void fetch_ghost(inout Particle row[columns + 1]) { row[ghost].displacement = from_right(row[0].displacement); }

void return_ghost(inout Particle row[columns + 1]) {
    int lane = int(gl_SubgroupInvocationID);
    vec3 moved = subgroupShuffle(row[ghost].displacement, uint(lane > 0 ? lane - 1 : 0));
    row[0].displacement = lane > 0 ? moved : row[0].displacement;
}
