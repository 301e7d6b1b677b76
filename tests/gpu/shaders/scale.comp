// Multiplies numbers by a specialised factor, adds a pushed term, in specialised workgroups.
#version 460
layout(local_size_x_id = 3, local_size_y = 1) in;
layout(constant_id = 5) const float factor = 1.0;
layout(push_constant) uniform Push { uint count; float term; };
layout(set = 0, binding = 0, std430) readonly buffer Source { float source[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Target { float target[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < count) target[i] = source[i] * factor + term + 1000.0 * float(gl_WorkGroupSize.x);
}
