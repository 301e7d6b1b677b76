#include <fmt/format.h>

#include "output/frame_table.h"
#include "output/frame_writer.h"
#include "output/npy.h"
#include "output/zip_file.h"

namespace drape {

namespace {

constexpr std::int32_t normal_node = 0, obstacle_node = 1, handle_node = 3;  // NodeType of MeshGraphNets' common.py

/// Writes all cloths as one mesh, cloth after cloth, then the colliders. Frames are collected in a file beside the
/// archive.
class Trajectory : public FrameWriter {
  public:
    Trajectory(OutputFolder& folder, const WrittenRun& run)
        : folder_(folder), run_(run), positions_(folder, "trajectory_frames.npz"), given_(folder) {
        for (const WrittenCloth& cloth : run_.cloths) node_count_ += cloth.particle_count();
        for (const WrittenCollider& collider : run_.obstacles) node_count_ += collider.vertices.size();
        positions_.append(bytes_of(header()));
    }

    void add(const WrittenFrame& frame) override {
        for (const std::span<const float> cloth : frame.positions)
            positions_.append(std::as_bytes(std::span<const float>(without_w(cloth))));
        for (const WrittenCollider& collider : run_.obstacles) {
            const std::vector<float> nodes = placed_vertices(collider, frame.number / run_.fps);
            positions_.append(std::as_bytes(std::span(nodes)));
        }
        ++frame_count_;
        FrameValues given;
        for (const auto& [name, value] : frame.values)
            if (is_given(name)) given[name] = value;
        given_.add(frame.number, given);
    }

    std::vector<FileRecord> finish() override {
        positions_.rewrite(0, bytes_of(header()));
        ZipFile archive(folder_, "trajectory.npz", run_.deflates);
        archive.add("world_pos.npy", positions_);
        add_mesh(archive);
        for (const std::string& name : given_.names()) {
            const std::vector<double> values = given_.column(name);
            archive.add(name + ".npy",
                        npy_array("<f8", fmt::format("{},", values.size()), std::as_bytes(std::span(values))));
        }
        for (const auto& [name, array] : run_.set) archive.add(name + ".npy", array);
        return {archive.commit()};
    }

  private:
    std::string header() const { return npy_header("<f4", fmt::format("{}, {}, 3", frame_count_, node_count_)); }

    void add_mesh(ZipFile& archive) const {
        std::vector<std::array<float, 2>> mesh_positions;
        std::vector<std::uint32_t> cells;
        std::vector<std::int32_t> types;
        for (const WrittenCloth& cloth : run_.cloths) {
            const auto first = static_cast<std::uint32_t>(types.size());
            std::vector<bool> in_cell(cloth.particle_count());  // particles in holes never move
            for (const std::uint32_t particle : cloth.faces) {
                cells.push_back(first + particle);
                in_cell[particle] = true;
            }
            for (std::size_t particle = 0; particle < cloth.particle_count(); ++particle) {
                const auto [u, v] = cloth.uv(particle);
                mesh_positions.push_back(
                    {static_cast<float>(u * cloth.size[0]), static_cast<float>(v * cloth.size[1])});
                const bool held = !in_cell[particle] || (!cloth.held.empty() && cloth.held[particle]);
                types.push_back(held ? handle_node : normal_node);
            }
        }
        // A solid body has no sheet to lie in.
        for (const WrittenCollider& collider : run_.obstacles) {
            const auto first = static_cast<std::uint32_t>(types.size());
            for (const std::uint32_t vertex : collider.faces) cells.push_back(first + vertex);
            types.insert(types.end(), collider.vertices.size(), obstacle_node);
            mesh_positions.insert(mesh_positions.end(), collider.vertices.size(), {0, 0});
        }
        archive.add("mesh_pos.npy",
                    npy_array("<f4", fmt::format("1, {}, 2", node_count_), std::as_bytes(std::span(mesh_positions))));
        archive.add("cells.npy",
                    npy_array("<i4", fmt::format("1, {}, 3", cells.size() / 3), std::as_bytes(std::span(cells))));
        archive.add("node_type.npy",
                    npy_array("<i4", fmt::format("1, {}, 1", node_count_), std::as_bytes(std::span(types))));
    }

    OutputFolder& folder_;
    WrittenRun run_;
    std::size_t node_count_ = 0, frame_count_ = 0;
    AtomicFile positions_;
    FrameTable given_;
};

}  // namespace

extern const OutputFormat mgn_format{
    .name = "mgn",
    .files = "trajectory.npz",
    .holds =
        "a trajectory of MeshGraphNets' flag_simple: world_pos, float32 [frame, node, 3], mesh_pos [1, node, 2], "
        "cells [1, cell, 3], node_type [1, node, 1]; colliders are nodes of type 1, as in sphere_simple; what was "
        "given to "
        "each frame, given_wind_x_m_s and so on [frame], and what overrides set, set/POINTER; not with cutters or tear",
    .is_archive = true,
    .follows_cuts = false,
    .frame_files = false,
    .frame_bytes =
        [](const FrameSize& frame) { return (frame.packed ? 1 : 2) * 12 * (frame.particles + frame.obstacle_nodes); },
    .owns = [](std::string_view name) { return name == "trajectory.npz" || name == "trajectory_frames.npz"; },
    .open = open_writer<Trajectory>};

}  // namespace drape
