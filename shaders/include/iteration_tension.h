// The tension of springs that a sweep relaxes (spring_stream.comp, spring_tile.comp), by first particle. TENSION stores
// that of the stretch springs, from zero on. CARRIED stores that of all springs, from where the iteration before left
// it, in other images than it reads: the part that strips or tiles have in common each of them reads.
#if defined(TENSION) || defined(CARRIED)
SCALAR_OUT(4, TensionRowOut, tension_row_out);
SCALAR_OUT(5, TensionColumnOut, tension_column_out);
#define STORE_TENSION_ROW(owner, value) STORE_SCALAR(tension_row_out, owner, value)
#define STORE_TENSION_COLUMN(owner, value) STORE_SCALAR(tension_column_out, owner, value)
#else
#define STORE_TENSION_ROW(owner, value)
#define STORE_TENSION_COLUMN(owner, value)
#endif

#ifdef CARRIED
layout(constant_id = 2) const bool first_iteration = true;
SCALAR_OUT(6, TensionDownRightOut, tension_shear_down_right_out);
SCALAR_OUT(7, TensionDownLeftOut, tension_shear_down_left_out);
layout(set = 0, binding = 8, r32f) uniform readonly image2D tension_row_in;
layout(set = 0, binding = 9, r32f) uniform readonly image2D tension_column_in;
layout(set = 0, binding = 10, r32f) uniform readonly image2D tension_shear_down_right_in;
layout(set = 0, binding = 11, r32f) uniform readonly image2D tension_shear_down_left_in;
/// Clamps to the grid: rows that a strip or tile lacks have no spring.
ivec2 tension_place(ivec2 owner) { return max(min(owner, push.grid - 1), ivec2(0)); }
#define CARRIED_TENSION(name, owner) (first_iteration ? 0.0f : LOAD(name, tension_place(owner)).x)
#define TENSION_ROW(owner) CARRIED_TENSION(tension_row_in, owner)
#define TENSION_COLUMN(owner) CARRIED_TENSION(tension_column_in, owner)
#define TENSION_DOWN_RIGHT(owner) CARRIED_TENSION(tension_shear_down_right_in, owner)
#define TENSION_DOWN_LEFT(owner) CARRIED_TENSION(tension_shear_down_left_in, owner)
#define STORE_TENSION_DOWN_RIGHT(owner, value) STORE_SCALAR(tension_shear_down_right_out, owner, value)
#define STORE_TENSION_DOWN_LEFT(owner, value) STORE_SCALAR(tension_shear_down_left_out, owner, value)
#else
#define TENSION_ROW(owner) 0.0f
#define TENSION_COLUMN(owner) 0.0f
#define TENSION_DOWN_RIGHT(owner) 0.0f
#define TENSION_DOWN_LEFT(owner) 0.0f
#define STORE_TENSION_DOWN_RIGHT(owner, value)
#define STORE_TENSION_DOWN_LEFT(owner, value)
#endif
