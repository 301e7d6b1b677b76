// Universal Scene Description has materials (https://openusd.org/release/spec_usdpreviewsurface.html) and the mesh
// schema UsdGeomMesh (https://openusd.org/release/api/class_usd_geom_mesh.html). Each cloth has a text file, whose
// points are time samples by frame number.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

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

/// Returns the bounds of points, x y z each at a distance of `stride`, as an extent.
std::string extent_text(std::span<const float> values, std::size_t stride) {
    std::array<float, 3> low, high;
    low.fill(std::numeric_limits<float>::max());
    high.fill(std::numeric_limits<float>::lowest());
    for (std::size_t i = 0; i + 2 < values.size(); i += stride)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], values[i + axis]);
            high[axis] = std::max(high[axis], values[i + axis]);
        }
    return fmt::format("[({}, {}, {}), ({}, {}, {})]", low[0], low[1], low[2], high[0], high[1], high[2]);
}

std::string points_text(std::span<const float> values, std::size_t stride) {
    std::string text = "[";
    for (std::size_t i = 0; i + 2 < values.size(); i += stride)
        fmt::format_to(std::back_inserter(text), "{}({}, {}, {})", i == 0 ? "" : ", ", values[i], values[i + 1],
                       values[i + 2]);
    return text + "]";
}

/// Every frame's text has the same width, so that it can be corrected in place.
std::string end_text(std::uint32_t frame) { return fmt::format("{:<10}", frame); }

/// Returns what a file says of its time behind the last frame, and of its world.
std::string stage_text(const WrittenRun& run, Up up) {
    return fmt::format(
        "\n    framesPerSecond = {}\n    metersPerUnit = 1\n    startTimeCode = {}\n    timeCodesPerSecond = {}\n"
        "    upAxis = \"{}\"\n)\n\n",
        run.fps, run.start, run.fps, up == Up::z ? 'Z' : 'Y');
}

/// Returns a file's beginning, with the last frame.
std::string stage_text(const WrittenRun& run, const char* default_prim, const char* doc, std::uint32_t last) {
    return fmt::format("#usda 1.0\n(\n    defaultPrim = \"{}\"\n    doc = \"{}\"\n    endTimeCode = {}{}", default_prim,
                       doc, last, stage_text(run, run.up));
}

constexpr std::string_view colliders_name = "colliders.usda", scene_name = "scene.usda";

/// A mesh that is placed by a matrix, of time samples where it moves; its points are samples where it deforms.
class UsdaCollider {
  public:
    UsdaCollider(const WrittenCollider& collider, double fps) : collider_(collider), fps_(fps) {}

    void add(std::uint32_t frame) {
        if (collider_.moves) matrices_ += sample_text(frame, matrix_at(frame));
        if (!collider_.form) return;
        const std::vector<float> points = points_at(frame);
        points_ += sample_text(frame, points_text(points, 3));
        extents_ += sample_text(frame, extent_text(points, 3));
    }

    std::string text(std::uint32_t first) const {
        const std::vector<float> points = points_at(first);
        const auto linear = [this](std::size_t i) {
            const double srgb = collider_.color[i];
            return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
        };
        return fmt::format(
            "    def Mesh \"{}\"\n    {{\n        uniform bool doubleSided = 1\n"
            "        uniform token subdivisionScheme = \"none\"\n        point3f[] points{}\n"
            "        float3[] extent{}\n        int[] faceVertexCounts = {}\n        int[] faceVertexIndices = {}\n"
            "        color3f[] primvars:displayColor = [({}, {}, {})]\n"
            "        matrix4d xformOp:transform{}\n        uniform token[] xformOpOrder = [\"xformOp:transform\"]\n"
            "    }}\n",
            collider_.name, value_text(points_text(points, 3), points_), value_text(extent_text(points, 3), extents_),
            count_list(collider_.faces.size() / 3), index_list(collider_.faces), static_cast<float>(linear(0)),
            static_cast<float>(linear(1)), static_cast<float>(linear(2)), value_text(matrix_at(first), matrices_));
    }

  private:
    static std::string sample_text(std::uint32_t frame, const std::string& value) {
        return fmt::format("            {}: {},\n", frame, value);
    }
    /// Returns the samples, if there are any, else the value.
    static std::string value_text(const std::string& value, const std::string& samples) {
        return samples.empty() ? " = " + value : fmt::format(".timeSamples = {{\n{}        }}", samples);
    }

    std::vector<float> points_at(std::uint32_t frame) const {
        std::vector<float> points;
        for (const Vec3& vertex : formed_vertices(collider_, frame / fps_))
            for (const double coordinate : vertex) points.push_back(static_cast<float>(coordinate));
        return points;
    }

    /// Points are row vectors, multiplied from the left to the matrix.
    std::string matrix_at(std::uint32_t frame) const {
        const Placement3x4 rows = collider_.placement(frame / fps_);
        std::string text;
        for (std::size_t column = 0; column < 4; ++column) {
            text += column == 0 ? "(" : ", ";
            for (std::size_t row = 0; row < 3; ++row)  // adding 0 makes -0 a 0
                text += fmt::format("{}{}", row == 0 ? "(" : ", ", rows[row][column] + 0.0);
            text += column == 3 ? ", 1))" : ", 0)";
        }
        return text;
    }

    WrittenCollider collider_;
    double fps_;
    std::string matrices_, points_, extents_;
};

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
        put(end_text(run.end) + stage_text(run, cloth.up) + fmt::format("def Mesh \"{}\"\n{{\n", name));
        put("    uniform bool doubleSided = 1\n    uniform token subdivisionScheme = \"none\"\n");
        put_uv();
        put("    point3f[] points.timeSamples = {\n");
    }

    void add(std::uint32_t frame, std::span<const float> xyzw) {
        put(fmt::format("        {}: {},\n", frame, points_text(xyzw, 4)));
        extents_ += fmt::format("        {}: {},\n", frame, extent_text(xyzw, 4));
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
    UsdaFiles(OutputFolder& folder, const WrittenRun& run) : folder_(folder), run_(run), last_(run.start) {
        for (const WrittenCloth& cloth : run_.cloths) files_.push_back(std::make_unique<UsdaFile>(folder, run_, cloth));
        for (const WrittenCollider& collider : run_.colliders) colliders_.emplace_back(collider, run_.fps);
    }

    void add(const WrittenFrame& frame) override {
        for (std::size_t cloth = 0; cloth < files_.size(); ++cloth)
            files_[cloth]->add(frame.number, frame.positions[cloth]);
        for (UsdaCollider& collider : colliders_) collider.add(frame.number);
        last_ = frame.number;
    }

    void set_faces(std::uint32_t frame, std::size_t cloth, const std::vector<std::uint32_t>& faces) override {
        files_[cloth]->set_faces(frame, faces);
    }

    std::vector<FileRecord> finish() override {
        std::vector<FileRecord> records;
        for (const auto& file : files_) records.push_back(file->finish());
        if (!colliders_.empty()) records.push_back(write_colliders());
        if (records.size() > 1) records.push_back(write_scene(records));
        return records;
    }

  private:
    FileRecord write_colliders() const {
        std::string text = stage_text(run_, "colliders", "Metres; a collider's number is that of contacts", last_);
        text += "def Xform \"colliders\"\n{\n";
        for (const UsdaCollider& collider : colliders_) text += collider.text(run_.start);
        return write_file(folder_, std::string(colliders_name), bytes_of(text + "}\n"));
    }

    /// All files together, each a prim of its own name.
    FileRecord write_scene(const std::vector<FileRecord>& parts) const {
        std::string text =
            stage_text(run_, "scene", "The cloths, and the colliders", last_) + "def Xform \"scene\"\n{\n";
        std::set<std::string> names;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            std::string name = i < run_.cloths.size() ? identifier(run_.cloths[i].label) : "colliders";
            while (!names.insert(name).second) name += '_';
            text += fmt::format("    def \"{}\" (\n        references = @./{}@\n    )\n    {{\n    }}\n", name,
                                parts[i].name);
        }
        return write_file(folder_, std::string(scene_name), bytes_of(text + "}\n"));
    }

    OutputFolder& folder_;
    WrittenRun run_;
    std::vector<std::unique_ptr<UsdaFile>> files_;
    std::vector<UsdaCollider> colliders_;
    std::uint32_t last_;
};

}  // namespace

extern const OutputFormat usda_format{
    .name = "usda",
    .files = "positions.usda, colliders.usda, scene.usda",
    .holds =
        "a USD mesh whose points are time samples by frame number, with texture coordinates; after a cut its faces "
        "are too; colliders are meshes that matrices place; scene.usda has all of the files, where there are several",
    .frame_files = false,
    .owns =
        [](std::string_view name) {
            return is_cloth_file_name(name, "positions", "usda") || name == colliders_name || name == scene_name;
        },
    .open = open_writer<UsdaFiles>};

}  // namespace drape
