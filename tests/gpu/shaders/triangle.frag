#version 460
layout(constant_id = 0) const float red = 0.0;
layout(push_constant) uniform Push { vec4 tint; };
layout(location = 0) out vec4 color;

void main() { color = vec4(red, tint.g, tint.b, 1.0); }
