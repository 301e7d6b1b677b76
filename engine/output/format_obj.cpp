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

}  // namespace

extern const OutputFormat obj_format{
    .name = "obj",
    .files = "mesh_FRAME.obj",
    .holds = "every particle, texture coordinates, and the triangles that no cut has split",
    .frame_files = true,
    .owns = [](std::string_view name) { return is_cloth_frame_file_name(name, "mesh", "obj"); },
    .open = [](OutputFolder& folder, const WrittenRun& run) -> std::unique_ptr<FrameWriter> {
        return std::make_unique<MeshSequence>(folder, run, "obj", mesh_text);
    }};

}  // namespace drape
