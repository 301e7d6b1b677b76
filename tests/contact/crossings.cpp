// `crossings RUN...` finds which triangles cross in the frames of runs. It judges the folders into which `drape
// simulate` or `drape render` wrote NPZ files, which hold the triangles too, from these alone. It prints a row per run;
// exit code 1 where something crosses that the manifest says is proved not to.
#include <fmt/format.h>
#include <json/json.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>

#include "crossing_checker.h"
#include "input/array_file.h"

namespace drape::test {
namespace {

using input::Array;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

struct RunCloth {
    std::string name;
    Array positions;
    std::map<std::uint64_t, Triangles> faces;  ///< by the frame from which on they hold
};

template <class T>
std::vector<T> values_of(const Array& array) {
    std::vector<T> values(array.bytes.size() / sizeof(T));
    std::memcpy(values.data(), array.bytes.data(), array.bytes.size());
    return values;
}

Triangles in_threes(const std::vector<std::int32_t>& corners) {
    Triangles triangles(corners.size() / 3);
    for (std::size_t i = 0; i < corners.size(); ++i) triangles[i / 3][i % 3] = static_cast<std::uint32_t>(corners[i]);
    return triangles;
}

/// Returns the cloth that a file holds, or nothing for another file. One cloth alone is not named.
std::optional<RunCloth> cloth_of(const std::filesystem::path& file) {
    const std::string stem = file.stem().string();
    if (!stem.starts_with("positions") || file.extension() != ".npz") return {};
    RunCloth cloth{stem == "positions" ? "" : stem.substr(std::strlen("positions_")), {}, {}};
    for (Array& array : input::load_arrays(file)) {
        if (array.name == "faces" || array.name.starts_with("faces_"))
            cloth.faces[array.name == "faces" ? 0 : std::stoull(array.name.substr(6))] =
                in_threes(values_of<std::int32_t>(array));
        else if (array.name == "positions")
            cloth.positions = std::move(array);
    }
    return cloth;
}

std::vector<RunCloth> cloths_of(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
    std::ranges::sort(files);
    std::vector<RunCloth> cloths;
    for (const auto& file : files)
        if (std::optional<RunCloth> cloth = cloth_of(file)) cloths.push_back(std::move(*cloth));
    if (cloths.empty()) throw std::runtime_error("no NPZ file of positions (drape simulate --export npz)");
    return cloths;
}

FloatMesh mesh_at(const RunCloth& cloth, std::uint64_t frame) {
    const std::vector<std::uint64_t>& shape = cloth.positions.shape;
    FloatMesh mesh{std::vector<FloatPoint>(shape[1] * shape[2]), std::prev(cloth.faces.upper_bound(frame))->second};
    const std::size_t bytes = mesh.points.size() * sizeof(FloatPoint);
    std::memcpy(mesh.points.data(), cloth.positions.bytes.data() + frame * bytes, bytes);
    return mesh;
}

/// The manifest's words on its run.
struct Told {
    bool meets = false, proved = false;
    std::int64_t first_unproved = -1, apart_since = -1;
    std::set<std::string> meet_themselves;
    std::set<std::pair<std::string, std::string>> excepted;
    double frame_ms = 0;

    explicit Told(const std::filesystem::path& folder) {
        Json::Value manifest;
        std::ifstream(folder / "manifest.json") >> manifest;
        frame_ms = manifest["run"]["frame_ms"]["median"].asDouble();
        const Json::Value& contact = manifest["self_collision"];
        meets = !contact.isNull();
        proved = contact["proved"].asBool();
        if (contact.isMember("first_unproved_frame")) first_unproved = contact["first_unproved_frame"].asInt64();
        if (contact.isMember("apart_since_frame")) apart_since = contact["apart_since_frame"].asInt64();
        for (const Json::Value& name : contact["cloths"]) meet_themselves.insert(name.asString());
        for (const Json::Value& pair : contact["crossed_at_start"])
            excepted.insert({pair[0].asString(), pair[1].asString()});
    }
    /// Returns whether a frame's crossing of these two contradicts the manifest.
    bool denies(std::int64_t frame, const std::string& one, const std::string& other, bool alone) const {
        if (!meets || (first_unproved >= 0 && frame >= first_unproved)) return false;
        if (one == other) return alone || meet_themselves.contains(one);
        if (apart_since >= 0 && frame >= apart_since) return true;
        return !excepted.contains({one, other}) && !excepted.contains({other, one});
    }
};

struct Judgement {
    std::size_t frames = 0, crossed_frames = 0, most = 0, touching = 0, denied = 0;
    std::int64_t first = -1;
    std::map<std::string, std::size_t> by_pair;
};

Judgement judge(const std::vector<RunCloth>& cloths, const Told& told) {
    Judgement judged;
    judged.frames = cloths.empty() ? 0 : cloths.front().positions.shape.at(0);
    for (std::uint64_t frame = 0; frame < judged.frames; ++frame) {
        std::vector<FloatMesh> meshes;
        for (const RunCloth& cloth : cloths) meshes.push_back(mesh_at(cloth, frame));
        const Crossings found = find_crossings(meshes);
        judged.touching += found.touching;
        if (found.pairs.empty()) continue;
        ++judged.crossed_frames;
        judged.most = std::max(judged.most, found.pairs.size());
        if (judged.first < 0) judged.first = static_cast<std::int64_t>(frame);
        for (const Crossing& each : found.pairs) {
            const auto [one, other] = std::minmax(each.mesh[0], each.mesh[1]);
            ++judged.by_pair[cloths[one].name + "-" + cloths[other].name];
            judged.denied +=
                told.denies(static_cast<std::int64_t>(frame), cloths[one].name, cloths[other].name, cloths.size() == 1)
                    ? 1
                    : 0;
        }
    }
    return judged;
}

bool report(const std::filesystem::path& folder) {
    const Told told(folder);
    const std::vector<RunCloth> cloths = cloths_of(folder);
    const Judgement judged = judge(cloths, told);
    const std::string proof = !told.meets                ? "no self-collision"
                              : told.proved              ? "proved"
                              : told.first_unproved >= 0 ? fmt::format("proved to frame {}", told.first_unproved - 1)
                                                         : "not proved";
    fmt::print("{}: {} cloth{}, {} frames, {:.3g} ms a frame; {}; crossings in {} frames", folder.string(),
               cloths.size(), cloths.size() == 1 ? "" : "s", judged.frames, told.frame_ms, proof,
               judged.crossed_frames);
    if (judged.crossed_frames > 0) fmt::print(", first {}, at most {} pairs", judged.first, judged.most);
    for (const auto& [pair, count] : judged.by_pair) fmt::print(", {} {}", pair, count);
    if (judged.touching > 0) fmt::print(", {} touching", judged.touching);
    if (judged.denied > 0) fmt::print("; {} WHERE PROVED", judged.denied);
    fmt::print("\n");
    return judged.denied == 0 && judged.frames > 0;
}

}  // namespace
}  // namespace drape::test

int main(int argc, char** argv) {
    bool good = argc > 1;
    for (int i = 1; i < argc; ++i) try {
            good &= drape::test::report(argv[i]);
        } catch (const std::exception& error) {
            fmt::print(stderr, "{}: {}\n", argv[i], error.what());
            good = false;
        }
    return good ? 0 : 1;
}
