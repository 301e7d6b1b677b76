#include "output/mesh_text.h"

#include <fmt/format.h>

#include <iterator>
#include <utility>

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

std::vector<std::uint32_t> joined_faces(const std::vector<PlacedCollider>& colliders) {
    std::vector<std::uint32_t> faces;
    std::uint32_t first = 0;
    for (const auto& [collider, vertices] : colliders) {
        for (const std::uint32_t corner : collider.faces) faces.push_back(first + corner);
        first += static_cast<std::uint32_t>(collider.vertices.size());
    }
    return faces;
}

std::vector<float> joined_vertices(const std::vector<PlacedCollider>& colliders) {
    std::vector<float> all;
    for (const auto& [collider, vertices] : colliders) all.insert(all.end(), vertices.begin(), vertices.end());
    return all;
}

void FaceSequence::add(const WrittenFrame& frame) {
    // Cuts are reported when they are found, while earlier frames may still wait for their pictures.
    std::erase_if(changes_, [&](Change& change) {
        const bool due = change.frame <= frame.number;
        if (due && !change.springs.empty())
            run_.cloths[change.cloth].springs = std::move(change.springs);
        else if (due)
            run_.cloths[change.cloth].faces = std::move(change.faces);
        return due;
    });
    for (std::size_t i = 0; i < run_.cloths.size(); ++i) {
        const WrittenCloth& cloth = run_.cloths[i];
        WrittenMesh mesh{frame.positions[i], {}, {}, {}, {}};
        if (!frame.velocities.empty()) mesh.velocities = frame.velocities[i];
        if (!frame.contacts.empty()) mesh.contacts = frame.contacts[i];
        if (!frame.tensions.empty()) mesh.tensions = frame.tensions[i];
        if (!frame.contact_forces.empty()) mesh.contact_forces = frame.contact_forces[i];
        const std::string name = cloth_frame_file_name("mesh", cloth, frame.number, frame_digits(run_.end), extension_);
        files_.push_back(write_file(folder_, name, bytes_of(texts_.cloth(cloth, mesh))));
    }
    add_colliders(frame.number);
}

/// An earlier run's files are removed at the first write, so colliders that stand still are written with the first
/// frame.
void FaceSequence::add_colliders(std::uint32_t frame) {
    if (!std::exchange(still_written_, true)) write_colliders(false, still_colliders_name(extension_), frame);
    write_colliders(true, moving_colliders_name(frame, frame_digits(run_.end), extension_), frame);
}

void FaceSequence::write_colliders(bool moving, const std::string& name, std::uint32_t frame) {
    std::vector<PlacedCollider> placed;
    for (const WrittenCollider& collider : run_.colliders)
        if (collider.moves == moving) placed.push_back({collider, placed_vertices(collider, frame / run_.fps)});
    if (placed.empty()) return;
    files_.push_back(write_file(folder_, name, bytes_of(texts_.colliders(placed, run_.up))));
}

void FaceSequence::set_faces(std::uint32_t frame, std::size_t cloth, const std::vector<std::uint32_t>& faces) {
    changes_.push_back({frame, cloth, faces, {}});
}

void FaceSequence::set_springs(std::uint32_t frame, std::size_t cloth, const std::vector<std::uint8_t>& springs) {
    changes_.push_back({frame, cloth, {}, springs});
}

}  // namespace drape
