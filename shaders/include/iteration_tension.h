// The tension of springs that an iteration relaxes (spring_stream.comp, spring_tile.comp), by first particle. Where
// `stores_stretch_tension`, that of the stretch springs is stored, starting from zero. Where `carries_tension`, that of
// all springs is stored, starting from the previous iteration's. It is written to other images than it is read from,
// since overlapping strips or tiles read the same part.
layout(constant_id = 2) const bool first_iteration = true;
layout(constant_id = 24) const bool stores_stretch_tension = false;
layout(constant_id = 25) const bool carries_tension = false;
const bool stores_tension = stores_stretch_tension || carries_tension;
SCALAR_OUT(4, tension_row_out);
SCALAR_OUT(5, tension_column_out);
SCALAR_OUT(6, tension_shear_down_right_out);
SCALAR_OUT(7, tension_shear_down_left_out);
layout(set = 0, binding = 8, r32f) uniform readonly image2D tension_row_in;
layout(set = 0, binding = 9, r32f) uniform readonly image2D tension_column_in;
layout(set = 0, binding = 10, r32f) uniform readonly image2D tension_shear_down_right_in;
layout(set = 0, binding = 11, r32f) uniform readonly image2D tension_shear_down_left_in;

/// Returns a place within the grid: springs of rows that a strip or tile lacks do not exist.
ivec2 tension_place(ivec2 owner) { return max(min(owner, push.grid - 1), ivec2(0)); }

/// Returns the tension with which a spring starts.
float tension_at(ivec2 owner, const int channel) {
    if (!carries_tension) return 0.0f;
    if (first_iteration) return 0.0f;
    ivec2 place = tension_place(owner);
    if (channel == 0) return LOAD(tension_row_in, place).x;
    if (channel == 1) return LOAD(tension_column_in, place).x;
    if (channel == 2) return LOAD(tension_shear_down_right_in, place).x;
    return LOAD(tension_shear_down_left_in, place).x;
}

void store_tension_at(ivec2 owner, const int channel, float tension) {
    if (!stores_tension) return;
    if (channel == 0) STORE_SCALAR(tension_row_out, owner, tension);
    if (channel == 1) STORE_SCALAR(tension_column_out, owner, tension);
    if (!carries_tension) return;
    if (channel == 2) STORE_SCALAR(tension_shear_down_right_out, owner, tension);
    if (channel == 3) STORE_SCALAR(tension_shear_down_left_out, owner, tension);
}
