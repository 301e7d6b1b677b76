#include "include/present.h"
// Declares a compute shader's push constants as `push`, a copy that is made before anything branches. On the default
// device, constants that a branch within a loop reads are loaded again in every round, lane by lane.
#define PUSH_CONSTANTS(type)                            \
    layout(push_constant) uniform Push { type given; }; \
    type push = given;
// The same for a pass over cloths together (include/together.h). Where `has_constants`, each cloth has its own
// constants, for the frame's first substep; `given` are the first cloth's, for the current substep.
#define CLOTH_CONSTANTS(type)                                                              \
    layout(push_constant) uniform Push { type given; };                                    \
    layout(constant_id = 30) const bool has_constants = false;                             \
    layout(set = 0, binding = 30, std430) readonly buffer Constants { type constants[]; }; \
    type constants_of(uint cloth) {                                                        \
        type own = given;                                                                  \
        if (has_constants) own = constants[cloth];                                         \
        return own;                                                                        \
    }                                                                                      \
    type push = constants_of(cloth_place());
