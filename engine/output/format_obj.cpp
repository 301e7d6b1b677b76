#include <fmt/format.h>

#include <iterator>
#include <numeric>

#include "output/mesh_text.h"

namespace drape {

namespace {

/// Every particle is a vertex, whatever was cut, so that the numbers stay.
std::string mesh_text(const WrittenCloth& cloth, const WrittenMesh& mesh) {
    std::vector<std::uint32_t> particles(cloth.particle_count());
    std::iota(particles.begin(), particles.end(), 0u);
    return obj_text(cloth, mesh.positions, particles);
}

std::string obj_colliders_text(const std::vector<PlacedCollider>& colliders, Up up) {
    std::string text = fmt::format("# Metres, {} up.\n", spelling(up_spellings, up));
    auto out = std::back_inserter(text);
    std::size_t first = 1;
    for (const auto& [collider, at] : colliders) {
        fmt::format_to(out, "o {}\n", collider.name);
        for (std::size_t i = 0; i + 2 < at.size(); i += 3)
            fmt::format_to(out, "v {} {} {}\n", at[i], at[i + 1], at[i + 2]);
        for (std::size_t i = 0; i + 2 < collider.faces.size(); i += 3)
            fmt::format_to(out, "f {} {} {}\n", first + collider.faces[i], first + collider.faces[i + 1],
                           first + collider.faces[i + 2]);
        first += collider.vertices.size();
    }
    return text;
}

}  // namespace

extern const OutputFormat obj_format{
    .name = "obj",
    .files = "mesh_FRAME.obj, colliders.obj, colliders_FRAME.obj",
    .holds =
        "every particle, texture coordinates, and the triangles that no cut has split; an object for every collider "
        "that stands still, and those that move by frame",
    .frame_files = true,
    .owns =
        [](std::string_view name) {
            return is_cloth_frame_file_name(name, "mesh", "obj") || is_colliders_name(name, "obj");
        },
    .open = [](OutputFolder& folder, const WrittenRun& run) -> std::unique_ptr<FrameWriter> {
        return std::make_unique<FaceSequence>(folder, run, "obj", MeshTexts{mesh_text, obj_colliders_text});
    }};

}  // namespace drape
