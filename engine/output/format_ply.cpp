// A binary PLY file is a text header, then vertices (x y z, s t) and triangles as they lie in memory.
#include <fmt/format.h>

#include <bit>

#include "output/mesh_text.h"

namespace drape {

static_assert(std::endian::native == std::endian::little, "meshes are written as they lie in memory");

namespace {

template <class T>
void append(std::string& text, T value) {
    text.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void append_faces(std::string& text, const std::vector<std::uint32_t>& faces) {
    for (std::size_t i = 0; i + 2 < faces.size(); i += 3) {
        append(text, std::uint8_t{3});
        for (std::size_t corner = 0; corner < 3; ++corner) append(text, faces[i + corner]);
    }
}

std::string ply_text(const WrittenCloth& cloth, const WrittenMesh& mesh) {
    const std::span<const float> xyzw = mesh.positions;
    std::string text = fmt::format(
        "ply\nformat binary_little_endian 1.0\ncomment metres, {} up; vertex row * columns + column is that "
        "particle\n"
        "element vertex {}\nproperty float x\nproperty float y\nproperty float z\nproperty float s\nproperty float t\n"
        "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        spelling(up_spellings, cloth.up), cloth.particle_count(), cloth.faces.size() / 3);
    for (std::size_t particle = 0; particle < cloth.particle_count(); ++particle) {
        for (std::size_t axis = 0; axis < 3; ++axis) append(text, xyzw[4 * particle + axis]);
        for (const float coordinate : cloth.uv(particle)) append(text, coordinate);
    }
    append_faces(text, cloth.faces);
    return text;
}

std::string ply_colliders_text(const std::vector<PlacedCollider>& colliders, Up up) {
    const std::vector<float> vertices = joined_vertices(colliders);
    const std::vector<std::uint32_t> faces = joined_faces(colliders);
    std::string text = fmt::format(
        "ply\nformat binary_little_endian 1.0\ncomment metres, {} up; colliders\nelement vertex {}\n"
        "property float x\nproperty float y\nproperty float z\nelement face {}\n"
        "property list uchar int vertex_indices\nend_header\n",
        spelling(up_spellings, up), vertices.size() / 3, faces.size() / 3);
    for (const float coordinate : vertices) append(text, coordinate);
    append_faces(text, faces);
    return text;
}

}  // namespace

extern const OutputFormat ply_format{
    .name = "ply",
    .files = "mesh_FRAME.ply, colliders.ply, colliders_FRAME.ply",
    .holds = "the same, binary; colliders are one mesh per file",
    .frame_files = true,
    .frame_bytes =
        [](const FrameSize& frame) {
            return 20 * frame.particles + 12 * frame.moving_vertices + 13 * (frame.triangles + frame.moving_triangles);
        },
    .owns =
        [](std::string_view name) {
            return is_cloth_frame_file_name(name, "mesh", "ply") || is_colliders_name(name, "ply");
        },
    .open = [](OutputFolder& folder, const WrittenRun& run) -> std::unique_ptr<FrameWriter> {
        return std::make_unique<FaceSequence>(folder, run, "ply", MeshTexts{ply_text, ply_colliders_text});
    }};

}  // namespace drape
