// Places a vertex of a cloth for drawing. Its index alone identifies it: the particles come first, then, on a `cut`
// cloth, the vertices on cut springs, each placed from particles of its own side. The includer has `push` (ClothPush)
// and the position image.
ivec2 particle_texel(uint particle) { return ivec2(particle % push.grid.x, particle / push.grid.x); }

vec3 particle_position(uint particle) { return imageLoad(position, particle_texel(particle)).xyz; }

layout(constant_id = 24) const bool cut = false;
layout(set = 0, binding = 5, std430) readonly buffer CutVertices { CutVertex cut_vertices[]; };

bool is_cut_vertex(uint index) { return index >= push.grid.x * push.grid.y; }

CutVertex cut_vertex(uint index) { return cut_vertices[index - push.grid.x * push.grid.y]; }

vec3 vertex_position(uint index) {
    if (cut)
        if (is_cut_vertex(index)) {
            CutVertex vertex = cut_vertex(index);
            vec3 anchor = particle_position(vertex.particles.x);
            return anchor + vertex.weights.x * (particle_position(vertex.particles.y) - anchor) +
                   vertex.weights.y * (particle_position(vertex.particles.z) - anchor) + vertex.offset.xyz;
        }
    return particle_position(index);
}
