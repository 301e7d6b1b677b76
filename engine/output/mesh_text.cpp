#include "output/mesh_text.h"

#include <fmt/format.h>

#include <iterator>

namespace drape {

std::string obj_text(const WrittenCloth& cloth, std::span<const float> xyzw,
                     const std::vector<std::uint32_t>& particles) {
    std::string text = fmt::format("# Metres, {} up.\n", spelling(up_spellings, cloth.up));
    auto out = std::back_inserter(text);
    std::vector<std::size_t> number(cloth.particle_count());
    std::size_t count = 0;
    for (const std::uint32_t particle : particles) {
        const float* at = &xyzw[4 * std::size_t{particle}];
        fmt::format_to(out, "v {} {} {}\n", at[0], at[1], at[2]);
        number[particle] = ++count;
    }
    for (const std::uint32_t particle : particles)
        fmt::format_to(out, "vt {} {}\n", cloth.uv(particle)[0], cloth.uv(particle)[1]);
    for (std::size_t i = 0; i + 2 < cloth.faces.size(); i += 3)
        fmt::format_to(out, "f {0}/{0} {1}/{1} {2}/{2}\n", number[cloth.faces[i]], number[cloth.faces[i + 1]],
                       number[cloth.faces[i + 2]]);
    return text;
}

void MeshSequence::add(const WrittenFrame& frame) {
    // Cuts are told of as they are found, when frames before them may still wait for their pictures.
    std::erase_if(changes_, [&](Change& change) {
        const bool due = change.frame <= frame.number;
        if (due) run_.cloths[change.cloth].faces = std::move(change.faces);
        return due;
    });
    for (std::size_t i = 0; i < run_.cloths.size(); ++i) {
        const WrittenCloth& cloth = run_.cloths[i];
        WrittenMesh mesh{frame.positions[i], {}, {}};
        if (!frame.velocities.empty()) mesh.velocities = frame.velocities[i];
        if (!frame.contacts.empty()) mesh.contacts = frame.contacts[i];
        const std::string name = cloth_frame_file_name("mesh", cloth, frame.number, frame_digits(run_.end), extension_);
        files_.push_back(write_file(folder_, name, bytes_of(text_(cloth, mesh))));
    }
}

void MeshSequence::set_faces(std::uint32_t frame, std::size_t cloth, const std::vector<std::uint32_t>& faces) {
    changes_.push_back({frame, cloth, faces});
}

}  // namespace drape
