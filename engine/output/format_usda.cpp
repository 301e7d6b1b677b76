// Universal Scene Description has materials (https://openusd.org/release/spec_usdpreviewsurface.html) and the mesh
// schema UsdGeomMesh (https://openusd.org/release/api/class_usd_geom_mesh.html). Each cloth has a text file, whose
// points are time samples by frame number.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>

#include "output/frame_writer.h"

namespace drape {

namespace {

/// Makes a prim's name: letters, digits and underscores, no digit first.
std::string identifier(const std::string& name) {
    std::string text = name.empty() ? "cloth" : name;
    const auto fits = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    };
    for (char& c : text)
        if (!fits(c)) c = '_';
    return text.front() >= '0' && text.front() <= '9' ? "_" + text : text;
}

std::string index_list(const std::vector<std::uint32_t>& values) {
    return fmt::format("[{}]", fmt::join(values, ", "));
}

std::string count_list(std::size_t triangles) { return index_list(std::vector<std::uint32_t>(triangles, 3)); }

class UsdaFile {
  public:
    UsdaFile(OutputFolder& folder, const WrittenRun& run, const WrittenCloth& cloth)
        : run_(run), cloth_(cloth), file_(folder, cloth_file_name("positions", cloth, "usda")) {
        faces_.emplace_back(run.start, cloth.faces);
        const std::string name = identifier(cloth.label);
        put(fmt::format(
            "#usda 1.0\n(\n    defaultPrim = \"{}\"\n    doc = \"Metres; point row * columns + column is that "
            "particle of {} columns and {} rows\"\n    endTimeCode = ",
            name, cloth.columns, cloth.rows));
        end_place_ = file_.size();
        put(
            fmt::format("{}\n    framesPerSecond = {}\n    metersPerUnit = 1\n    startTimeCode = {}\n"
                        "    timeCodesPerSecond = {}\n    upAxis = \"{}\"\n)\n\ndef Mesh \"{}\"\n{{\n",
                        end_text(run.end), run.fps, run.start, run.fps, cloth.up == Up::z ? 'Z' : 'Y', name));
        put("    uniform bool doubleSided = 1\n    uniform token subdivisionScheme = \"none\"\n");
        put_uv();
        put("    point3f[] points.timeSamples = {\n");
    }

    void add(std::uint32_t frame, std::span<const float> xyzw) {
        std::string text = fmt::format("        {}: [", frame);
        auto out = std::back_inserter(text);
        std::array<float, 3> low, high;
        low.fill(std::numeric_limits<float>::max());
        high.fill(std::numeric_limits<float>::lowest());
        for (std::size_t i = 0; i + 3 < xyzw.size(); i += 4) {
            fmt::format_to(out, "{}({}, {}, {})", i == 0 ? "" : ", ", xyzw[i], xyzw[i + 1], xyzw[i + 2]);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                low[axis] = std::min(low[axis], xyzw[i + axis]);
                high[axis] = std::max(high[axis], xyzw[i + axis]);
            }
        }
        put(text += "],\n");
        extents_ += fmt::format("        {}: [({}, {}, {}), ({}, {}, {})],\n", frame, low[0], low[1], low[2], high[0],
                                high[1], high[2]);
        last_ = frame;
    }

    /// A sample holds until the next one; a cut before the first frame changes the first sample.
    void set_faces(std::uint32_t frame, const std::vector<std::uint32_t>& faces) {
        if (frame <= faces_.back().first)
            faces_.back().second = faces;
        else
            faces_.emplace_back(frame, faces);
    }

    FileRecord finish() {
        put("    }\n    float3[] extent.timeSamples = {\n" + extents_ + "    }\n");
        put_faces();
        put("}\n");
        file_.rewrite(end_place_, bytes_of(end_text(last_)));
        return file_.commit();
    }

  private:
    /// Every frame's text is as wide, so that it can be corrected in place.
    static std::string end_text(std::uint32_t frame) { return fmt::format("{:<10}", frame); }

    void put(const std::string& text) { file_.append(bytes_of(text)); }

    void put_uv() {
        std::string text = "    texCoord2f[] primvars:st = [";
        for (std::size_t particle = 0; particle < cloth_.particle_count(); ++particle) {
            const auto [s, t] = cloth_.uv(particle);
            text += fmt::format("{}({}, {})", particle == 0 ? "" : ", ", s, t);
        }
        put(text + "] (\n        interpolation = \"vertex\"\n    )\n");
    }

    void put_faces() {
        std::erase_if(faces_, [this](const auto& sample) { return sample.first > last_; });
        if (faces_.size() == 1) {
            put(fmt::format("    int[] faceVertexCounts = {}\n    int[] faceVertexIndices = {}\n",
                            count_list(faces_[0].second.size() / 3), index_list(faces_[0].second)));
            return;
        }
        std::string counts = "    int[] faceVertexCounts.timeSamples = {\n",
                    indices = "    int[] faceVertexIndices.timeSamples = {\n";
        for (const auto& [frame, faces] : faces_) {
            counts += fmt::format("        {}: {},\n", frame, count_list(faces.size() / 3));
            indices += fmt::format("        {}: {},\n", frame, index_list(faces));
        }
        put(counts + "    }\n" + indices + "    }\n");
    }

    WrittenRun run_;
    WrittenCloth cloth_;
    AtomicFile file_;
    std::uint64_t end_place_ = 0;
    std::uint32_t last_ = 0;
    std::string extents_;
    std::vector<std::pair<std::uint32_t, std::vector<std::uint32_t>>> faces_;  ///< faces from that frame on
};

class UsdaFiles : public FrameWriter {
  public:
    UsdaFiles(OutputFolder& folder, const WrittenRun& run) {
        for (const WrittenCloth& cloth : run.cloths) files_.push_back(std::make_unique<UsdaFile>(folder, run, cloth));
    }

    void add(const WrittenFrame& frame) override {
        for (std::size_t cloth = 0; cloth < files_.size(); ++cloth)
            files_[cloth]->add(frame.number, frame.positions[cloth]);
    }

    void set_faces(std::uint32_t frame, std::size_t cloth, const std::vector<std::uint32_t>& faces) override {
        files_[cloth]->set_faces(frame, faces);
    }

    std::vector<FileRecord> finish() override {
        std::vector<FileRecord> records;
        for (const auto& file : files_) records.push_back(file->finish());
        return records;
    }

  private:
    std::vector<std::unique_ptr<UsdaFile>> files_;
};

}  // namespace

extern const OutputFormat usda_format{
    .name = "usda",
    .files = "positions.usda",
    .holds =
        "a USD mesh whose points are time samples by frame number, with texture coordinates; after a cut its faces "
        "are too",
    .frame_files = false,
    .owns = [](std::string_view name) { return is_cloth_file_name(name, "positions", "usda"); },
    .open = open_writer<UsdaFiles>};

}  // namespace drape
