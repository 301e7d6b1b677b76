// Hands on more than any device takes, in every kind of variable that takes more than one location.
#version 460
struct Look {
    vec4 color;
    mat3 turned;
    vec2 tiles[60];
};
layout(location = 1) out float depth;
layout(location = 2) flat out Look look;  // to 65
layout(location = 67) out vec3 normals[2];

void main() {
    depth = float(gl_VertexIndex);
    look.color = vec4(depth);
    look.turned = mat3(depth);
    for (int i = 0; i < 60; ++i) look.tiles[i] = vec2(depth);
    normals = vec3[2](vec3(depth), vec3(depth));
    gl_Position = vec4(depth);
}
