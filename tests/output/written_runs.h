// The tests of output formats write this small run, with a cut in it.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <vector>

#include "output/frame_writer.h"

namespace drape {

using Positions = std::vector<float>;  ///< x y z per particle

/// Returns a triangle that stands still, or rises by 1 m/s while it turns a quarter about y in a second.
inline WrittenCollider triangle_collider(bool moves) {
    WrittenCollider one{.name = moves ? "collider_1_mesh" : "collider_0_mesh",
                        .number = moves ? 1 : 0,
                        .vertices = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                        .faces = {0, 1, 2},
                        .moves = moves};
    one.placement = [moves](double time) -> Placement3x4 {
        const double angle = moves ? time * std::numbers::pi / 2 : 0, c = std::cos(angle), s = std::sin(angle);
        return {{{c, 0, s, 0}, {0, 1, 0, moves ? time : 3}, {-s, 0, c, 0}}};
    };
    return one;
}

/// Two cloths, of 3 x 2 and 2 x 2 particles; the first loses a triangle with frame 12. A collider moves, another does
/// not.
inline WrittenRun two_cloths() {
    WrittenRun run;
    run.start = 10, run.end = 14, run.step = 2, run.fps = 50, run.cuts = true;
    run.width = 4, run.height = 2, run.key = "key";
    run.scene = R"({"name": "\u00e9"})", run.parameters = R"({"method": "line"})", run.seed = 7;
    run.cloths = {{"flag", 3, 2, {0, 3, 1, 1, 3, 4, 1, 4, 2, 2, 4, 5}, "flag"},
                  {"rag", 2, 2, {0, 2, 1, 1, 2, 3}, "2nd rag"}};
    run.cloths[1].up = Up::z;
    run.colliders = run.obstacles = {triangle_collider(false), triangle_collider(true)};
    return run;
}

inline const std::vector<std::uint32_t> whole_flag = two_cloths().cloths[0].faces, cut_flag{0, 3, 1, 1, 4, 2, 2, 4, 5};

/// Returns numbers that a detour over decimals would round.
inline Positions positions_of(std::uint32_t frame, std::size_t particles) {
    Positions values(particles * 3);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<float>((frame + 1.0) / 3 + static_cast<double>(i) * 1e-7 - (i % 3 == 1 ? 2e6 : 0));
    return values;
}

inline std::vector<float> with_w(const Positions& xyz) {
    std::vector<float> xyzw;
    for (std::size_t i = 0; i < xyz.size(); ++i) {
        xyzw.push_back(xyz[i]);
        if (i % 3 == 2) xyzw.push_back(-9);
    }
    return xyzw;
}

/// Returns a picture of the run's size, every byte of which is another.
inline std::vector<std::uint8_t> picture_of(std::uint32_t frame) {
    std::vector<std::uint8_t> rgba(4 * 2 * 4);
    for (std::size_t i = 0; i < rgba.size(); ++i) rgba[i] = static_cast<std::uint8_t>(7 * i + frame);
    return rgba;
}

/// Returns layers of the run's size: in each row nothing, cloth, a collider and a fixture.
inline std::vector<LayerPixel> layers_of(std::uint32_t frame) {
    const auto at = static_cast<float>(frame);
    const std::vector<LayerPixel> row{
        {}, {at, {0, 32767, 0}, 1, 0.25f}, {2.5f * at, {-32767, 0, 0}, 3, 0}, {1e6f, {0, 0, -32767}, fixture_id, 0}};
    std::vector<LayerPixel> both = row;
    both.insert(both.end(), row.begin(), row.end());
    return both;
}

/// Writes `frames` frames of the run, with the cut, of which a run may tell before the frames that come before it.
/// Velocities are the positions of the frame after, contacts the particles' numbers less 1; only the second frame has
/// an error.
inline std::vector<FileRecord> write(FrameWriter& writer, std::uint32_t frames = 3, bool finish = true) {
    const WrittenRun run = two_cloths();
    writer.set_faces(12, 0, cut_flag);
    for (std::uint32_t frame = run.start; frame < run.start + frames * run.step; frame += run.step) {
        std::vector<std::vector<float>> xyzw, velocities;
        std::vector<std::vector<std::int16_t>> contacts;
        for (const WrittenCloth& cloth : run.cloths) {
            xyzw.push_back(with_w(positions_of(frame, cloth.particle_count())));
            velocities.push_back(with_w(positions_of(frame + 1, cloth.particle_count())));
            contacts.emplace_back(cloth.particle_count());
            std::iota(contacts.back().begin(), contacts.back().end(), std::int16_t{-1});
        }
        FrameValues values{{"flag/energy_j", frame}, {"substeps", 4}, {"energy_j", 99}};
        if (frame == 12) values["flag/stretch_error_rms"] = 0.25;
        const std::vector<std::uint8_t> rgba = picture_of(frame);
        const std::vector<LayerPixel> layers = layers_of(frame);
        writer.add({frame,
                    rgba,
                    {xyzw.begin(), xyzw.end()},
                    {velocities.begin(), velocities.end()},
                    {contacts.begin(), contacts.end()},
                    values,
                    layers});
    }
    return finish ? writer.finish() : std::vector<FileRecord>{};
}

inline std::vector<FileRecord> write(const char* format, OutputFolder& folder) {
    return write(*find_output_format(format)->open(folder, two_cloths()));
}

}  // namespace drape
