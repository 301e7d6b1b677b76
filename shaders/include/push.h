// Push constants of a compute shader, as `push`: a copy of them, made before anything branches. On the default device
// what a branch within a loop reads of the constants themselves is loaded anew in every round, lane by lane.
#define PUSH_CONSTANTS(type)                            \
    layout(push_constant) uniform Push { type given; }; \
    type push = given;
