// Declares a compute shader's push constants as `push`, a copy of them made before anything branches. On the default
// device the constants that a branch within a loop reads are loaded anew in every round, lane by lane.
#define PUSH_CONSTANTS(type)                            \
    layout(push_constant) uniform Push { type given; }; \
    type push = given;
