#include "report/space.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <set>
#include <span>
#include <utility>

#include "base/output_error.h"
#include "drape/scene_reader.h"
#include "input/array_file.h"
#include "mesh/mesh_shape.h"
#include "output/frame_writer.h"
#include "output/json_text.h"
#include "output/xml_text.h"
#include "picture/collider_surface.h"
#include "picture/color_map.h"
#include "picture/framing.h"
#include "world/collider_pose.h"
#include "world/motion.h"

namespace drape::report {

namespace {

using input::Array;
using Triangle = std::array<std::uint32_t, 3>;
using Triangles = std::vector<Triangle>;

constexpr std::size_t most_space_frames = 240, least_space_frames = 60;

/// The archive of a cloth; the faces hold from their frame on.
struct ClothArrays {
    std::string scene;
    std::uint32_t rows = 0, columns = 0;
    std::vector<double> times;
    std::vector<std::int64_t> frames;
    std::vector<float> positions;
    std::vector<std::pair<std::int64_t, Triangles>> faces;

    std::size_t particle_count() const { return std::size_t{rows} * columns; }
    const float* at(std::size_t frame, std::size_t particle) const {
        return &positions[(frame * particle_count() + particle) * 3];
    }
};

OutputError strange(const std::filesystem::path& path, const std::string& what) {
    return OutputError(fmt::format("'{}' is no archive of this program: {}", path.string(), what));
}

Triangles triangles_in(const Array& array, std::size_t particle_count, const std::filesystem::path& path) {
    if (array.type != "<i4" || array.shape.size() != 2 || array.shape[1] != 3)
        throw strange(path, fmt::format("'{}' is {}", array.name, array.text()));
    Triangles triangles(array.shape[0]);
    if (!triangles.empty()) std::memcpy(triangles.data(), array.bytes.data(), array.bytes.size());
    for (const Triangle& triangle : triangles)
        if (std::ranges::any_of(triangle, [&](std::uint32_t corner) { return corner >= particle_count; }))
            throw strange(path, fmt::format("'{}' names a particle that is not there", array.name));
    return triangles;
}

/// A text that is no array of numbers has four bytes per character.
std::string text_in(const Array& array) {
    std::string text;
    for (std::size_t i = 0; i + 3 < array.bytes.size(); i += 4) text += static_cast<char>(array.bytes[i]);
    return text;
}

ClothArrays read_cloth_arrays(const std::filesystem::path& path) {
    const auto is_wanted = [](std::string_view name) {
        return name == "scene" || name == "positions" || name == "frames" || name == "times" ||
               name.starts_with("faces");
    };
    ClothArrays cloth;
    const std::vector<Array> arrays = input::load_arrays(path, is_wanted);
    const auto numbers = [&](const std::string& name, std::size_t dimensions) -> const Array& {
        const auto found = std::ranges::find(arrays, name, &Array::name);
        if (found == arrays.end() || !found->has_numbers() || found->shape.size() != dimensions)
            throw strange(path, fmt::format("it has no such '{}'", name));
        return *found;
    };
    const Array &positions = numbers("positions", 4), &frames = numbers("frames", 1), &times = numbers("times", 1);
    if (positions.type != "<f4" || positions.shape[3] != 3 || positions.shape[0] != frames.count() ||
        positions.shape[0] != times.count())
        throw strange(path, fmt::format("'positions' is {}", positions.text()));
    cloth.rows = static_cast<std::uint32_t>(positions.shape[1]);
    cloth.columns = static_cast<std::uint32_t>(positions.shape[2]);
    cloth.positions.resize(positions.count());
    if (!cloth.positions.empty()) std::memcpy(cloth.positions.data(), positions.bytes.data(), positions.bytes.size());
    for (std::size_t i = 0; i < frames.count(); ++i) {
        cloth.frames.push_back(static_cast<std::int64_t>(frames.value(i)));
        cloth.times.push_back(times.value(i));
    }
    for (const Array& array : arrays) {
        if (array.name == "scene") cloth.scene = text_in(array);
        if (!array.name.starts_with("faces")) continue;
        const std::int64_t from = array.name == "faces" ? 0 : std::atoll(array.name.substr(6).c_str());
        cloth.faces.emplace_back(from, triangles_in(array, cloth.particle_count(), path));
    }
    std::ranges::sort(cloth.faces, {}, &std::pair<std::int64_t, Triangles>::first);
    if (cloth.faces.empty() || cloth.rows < 2 || cloth.columns < 2) throw strange(path, "it has no faces");
    return cloth;
}

template <class T>
std::string base64_of(const std::vector<T>& values) {
    static_assert(std::endian::native == std::endian::little, "the page's arrays are little-endian");
    const auto* begin = reinterpret_cast<const std::uint8_t*>(values.data());
    return base64(std::vector<std::uint8_t>(begin, begin + values.size() * sizeof(T)));
}

Json::Value json_of(const Vec3& vector) {
    return json_array(vector, [](double entry) { return Json::Value(entry); });
}

/// Numbers of rows or columns that are kept: every stride-th, and the last.
std::vector<std::uint32_t> kept_lines(std::uint32_t count, std::uint32_t stride) {
    std::vector<std::uint32_t> kept;
    for (std::uint32_t line = 0; line + 1 < count; line += stride) kept.push_back(line);
    kept.push_back(count - 1);
    return kept;
}

/// Frames, and particles of a cloth, that the page keeps.
struct Kept {
    std::vector<std::size_t> frames;
    std::uint32_t stride = 1;
    bool forms = true;  ///< those of every frame, of meshes that deform; else their first ones
};

/// A particle of a frame has 6 bytes of position and one of strain, a vertex of a mesh that deforms 6; base64 makes 4
/// of 3 bytes. Meshes may take half of them.
Kept what_fits(const std::vector<ClothArrays>& cloths, const SceneDescription& scene, double megabytes) {
    const std::size_t all = cloths.front().frames.size(), least = std::min(all, least_space_frames);
    double form_bytes = 0;
    for (const Collider& collider : scene.colliders)
        if (collider.deforms())
            form_bytes += static_cast<double>(std::get<Mesh>(collider.shape).shape->vertices().size()) * 6 * 4 / 3;
    const bool forms = form_bytes * static_cast<double>(least) <= megabytes * 1e6 / 2;
    for (Kept kept{.forms = forms};; ++kept.stride) {
        double bytes = forms ? form_bytes : 0;
        bool is_least = true;
        for (const ClothArrays& cloth : cloths) {
            const std::size_t rows = kept_lines(cloth.rows, kept.stride).size();
            const std::size_t columns = kept_lines(cloth.columns, kept.stride).size();
            bytes += static_cast<double>(rows * columns) * 7 * 4 / 3;
            is_least = is_least && rows == 2 && columns == 2;
        }
        const double fit = std::max(1.0, std::floor(megabytes * 1e6 / bytes));
        const auto frames = static_cast<std::size_t>(std::min(fit, static_cast<double>(most_space_frames)));
        if (frames < least && !is_least) continue;
        kept.frames = evenly_chosen(all, frames);
        return kept;
    }
}

/// The strains of the springs along rows and columns that a face still has beside it.
class Strains {
  public:
    Strains(const ClothArrays& arrays, const Cloth& cloth)
        : arrays_(arrays), along_rows_(grid_spacing(cloth)[0]), along_columns_(grid_spacing(cloth)[1]) {}

    /// The largest at every particle, 0 where all are below; shape [row, column].
    std::vector<double> largest(std::size_t frame) {
        find_springs(arrays_.frames[frame]);
        std::vector<double> strains(arrays_.particle_count(), 0.0);
        const auto add = [&](std::size_t a, std::size_t b, double rest) {
            const float *p = arrays_.at(frame, a), *q = arrays_.at(frame, b);
            const double strain = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) / rest - 1;
            for (const std::size_t end : {a, b}) strains[end] = std::max(strains[end], strain);
        };
        for (std::size_t i = 0; i < strains.size(); ++i) {
            if (right_[i]) add(i, i + 1, along_rows_);
            if (below_[i]) add(i, i + arrays_.columns, along_columns_);
        }
        return strains;
    }

  private:
    void find_springs(std::int64_t frame) {
        const Triangles* now = &arrays_.faces.front().second;
        for (const auto& [from, faces] : arrays_.faces)
            if (from <= frame) now = &faces;
        if (now == known_) return;
        known_ = now;
        right_.assign(arrays_.particle_count(), false);
        below_ = right_;
        for (const Triangle& face : *now)
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const auto [a, b] = std::minmax(face[corner], face[(corner + 1) % 3]);
                if (b == a + 1) right_[a] = true;
                if (b == a + arrays_.columns) below_[a] = true;
            }
    }

    const ClothArrays& arrays_;
    double along_rows_, along_columns_;
    const Triangles* known_ = nullptr;
    std::vector<bool> right_, below_;  ///< by particle: the spring to the next column, to the next row
};

/// Triangles of the kept particles, and when which of them are there.
class KeptTriangles {
  public:
    KeptTriangles(const ClothArrays& arrays, std::uint32_t stride)
        : arrays_(arrays),
          stride_(stride),
          columns_(static_cast<std::uint32_t>(kept_lines(arrays.columns, stride).size())) {
        if (stride == 1) {
            triangles_ = arrays.faces.front().second;
            return;
        }
        const auto rows = static_cast<std::uint32_t>(kept_lines(arrays.rows, stride).size());
        for (std::uint32_t row = 0; row + 1 < rows; ++row)
            for (std::uint32_t column = 0; column + 1 < columns_; ++column) {
                const std::uint32_t a = row * columns_ + column, b = a + 1, c = a + columns_, d = c + 1;
                triangles_.push_back({a, c, b});
                triangles_.push_back({b, c, d});
            }
    }

    Json::Value indices() const {
        std::vector<std::uint32_t> flat;
        for (const Triangle& triangle : triangles_) flat.insert(flat.end(), triangle.begin(), triangle.end());
        return base64_of(flat);
    }

    Json::Value changes() const {
        Json::Value list(Json::arrayValue);
        for (const auto& [from, faces] : arrays_.faces) {
            const std::vector<bool> alive = stride_ == 1 ? alive_faces(faces) : alive_cells(faces);
            std::vector<std::uint8_t> bits((alive.size() + 7) / 8, 0);
            for (std::size_t i = 0; i < alive.size(); ++i)
                if (alive[i]) bits[i / 8] = static_cast<std::uint8_t>(bits[i / 8] | 1u << i % 8);
            list.append(json_object({{"frame", from}, {"alive", base64_of(bits)}}));
        }
        return list;
    }

  private:
    std::vector<bool> alive_faces(const Triangles& faces) const {
        const std::set<Triangle> there(faces.begin(), faces.end());
        std::vector<bool> alive;
        for (const Triangle& triangle : triangles_) alive.push_back(there.contains(triangle));
        return alive;
    }

    /// A kept cell is there while half of its faces are.
    std::vector<bool> alive_cells(const Triangles& faces) const {
        std::vector<std::uint32_t> counts(triangles_.size() / 2, 0), capacity = counts;
        const auto cell_of = [&](std::uint32_t row, std::uint32_t column) {
            return std::size_t{row / stride_} * (columns_ - 1) + column / stride_;
        };
        for (std::uint32_t row = 0; row + 1 < arrays_.rows; ++row)
            for (std::uint32_t column = 0; column + 1 < arrays_.columns; ++column) capacity[cell_of(row, column)] += 2;
        for (const Triangle& face : faces) {
            std::uint32_t row = arrays_.rows, column = arrays_.columns;
            for (const std::uint32_t corner : face) {
                row = std::min(row, corner / arrays_.columns);
                column = std::min(column, corner % arrays_.columns);
            }
            ++counts[cell_of(std::min(row, arrays_.rows - 2), std::min(column, arrays_.columns - 2))];
        }
        std::vector<bool> alive;
        for (std::size_t cell = 0; cell < counts.size(); ++cell)
            alive.insert(alive.end(), 2, 2 * counts[cell] >= capacity[cell]);
        return alive;
    }

    const ClothArrays& arrays_;
    std::uint32_t stride_, columns_;
    Triangles triangles_;
};

/// Positions in 16 bits per axis of the box that they fill; those that are not finite lie in its corner.
void put_positions(Json::Value& json, const std::vector<float>& xyz) {
    Vec3 low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
    for (std::size_t i = 0; i < xyz.size(); ++i) {
        if (!std::isfinite(xyz[i])) continue;
        low[i % 3] = std::min(low[i % 3], double{xyz[i]});
        high[i % 3] = std::max(high[i % 3], double{xyz[i]});
    }
    for (std::size_t k = 0; k < 3; ++k)
        if (!(high[k] >= low[k])) low[k] = high[k] = 0;
    std::vector<std::uint16_t> values;
    for (std::size_t i = 0; i < xyz.size(); ++i) {
        const double side = high[i % 3] - low[i % 3];
        const double share = side > 0 && std::isfinite(xyz[i]) ? (xyz[i] - low[i % 3]) / side : 0;
        values.push_back(static_cast<std::uint16_t>(std::lround(share * 65535)));
    }
    json["positions"] = base64_of(values);
    json["low"] = json_of(low);
    json["high"] = json_of(high);
}

void put_strains(Json::Value& json, const std::vector<double>& strains) {
    std::vector<double> sorted;
    std::ranges::copy_if(strains, std::back_inserter(sorted), [](double strain) { return std::isfinite(strain); });
    double range = 0;
    if (!sorted.empty()) {
        const auto most = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 99 / 100);
        std::ranges::nth_element(sorted, most);
        range = *most;
    }
    std::vector<std::uint8_t> values;
    for (const double strain : strains) {
        const double share = std::isfinite(strain) && range > 0 ? std::min(strain / range, 1.0) : 0;
        values.push_back(static_cast<std::uint8_t>(std::lround(share * 255)));
    }
    json["strain"] = base64_of(values);
    json["strain_range"] = range;
}

Json::Value cloth_json(const ClothArrays& arrays, const Cloth& cloth, const Kept& kept) {
    const std::vector<std::uint32_t> rows = kept_lines(arrays.rows, kept.stride);
    const std::vector<std::uint32_t> columns = kept_lines(arrays.columns, kept.stride);
    Strains of_springs(arrays, cloth);
    std::vector<float> xyz;
    std::vector<double> strains;
    for (const std::size_t frame : kept.frames) {
        const std::vector<double> largest = of_springs.largest(frame);
        for (const std::uint32_t row : rows)
            for (const std::uint32_t column : columns) {
                const std::size_t particle = std::size_t{row} * arrays.columns + column;
                xyz.insert(xyz.end(), arrays.at(frame, particle), arrays.at(frame, particle) + 3);
                strains.push_back(largest[particle]);
            }
    }
    const KeptTriangles triangles(arrays, kept.stride);
    Json::Value json = json_object({{"name", cloth.name},
                                    {"rows", Json::Value::UInt64{rows.size()}},
                                    {"columns", Json::Value::UInt64{columns.size()}},
                                    {"stride", kept.stride},
                                    {"triangles", triangles.indices()},
                                    {"changes", triangles.changes()},
                                    {"front", json_of(cloth.appearance.front)},
                                    {"back", json_of(back_of(cloth.appearance))}});
    put_positions(json, xyz);
    put_strains(json, strains);
    return json;
}

/// Poses at the times, one where they are all the same.
template <class PoseAt>
Json::Value poses_json(const std::vector<double>& times, bool moves, const PoseAt& pose_at) {
    std::vector<float> values;
    for (const double time : times) {
        const ColliderPose pose = pose_at(time);
        for (const double entry : pose.rotation) values.push_back(static_cast<float>(entry));
        for (const double entry : pose.center) values.push_back(static_cast<float>(entry));
        if (!moves) break;
    }
    return base64_of(values);
}

/// `times`: those of which it has the forms.
void put_mesh(Json::Value& json, const Collider& collider, std::span<const double> times) {
    std::vector<float> vertices;
    for (const double time : times) {
        const Collider now = formed(collider, time);
        for (const Vec3& vertex : std::get<Mesh>(now.shape).shape->vertices())
            for (const double entry : vertex) vertices.push_back(static_cast<float>(entry));
    }
    std::vector<std::uint32_t> corners;
    for (const Triangle& triangle : std::get<Mesh>(collider.shape).shape->triangles())
        corners.insert(corners.end(), triangle.begin(), triangle.end());
    put_positions(json, vertices);
    json["triangles"] = base64_of(corners);
}

static_assert(std::variant_size_v<ColliderShape> == 6, "the page draws each kind by a row of `shapes` in viewer.js");

Json::Value collider_json(const Collider& collider, const std::vector<double>& times, bool forms) {
    const auto pose_at = [&](double time) { return surface_pose(collider, time); };
    Json::Value json = json_object({{"kind", std::string(collider_lists[collider.shape.index()])},
                                    {"size", json_of(shape_geometry(collider.shape).size)},
                                    {"color", json_of(collider.color)},
                                    {"poses", poses_json(times, collider.path.moves(), pose_at)}});
    if (special(collider.shape).mesh)
        put_mesh(json, collider, std::span(times).first(collider.deforms() && forms ? times.size() : 1));
    return json;
}

Json::Value cutter_json(const Cutter& cutter, const std::vector<double>& times) {
    Vec3 centroid{};
    for (const Vec3& corner : cutter.triangle)
        for (std::size_t k = 0; k < 3; ++k) centroid[k] += corner[k] / 3;
    const auto pose_at = [&](double time) {
        const RigidTransform motion = motion_at(cutter.path, time);
        ColliderPose pose{motion.rotation, centroid};
        for (std::size_t k = 0; k < 3; ++k) pose.center[k] += motion.translation[k];
        return pose;
    };
    Json::Value corners(Json::arrayValue), active(Json::arrayValue);
    for (const Vec3& corner : cutter.triangle)
        corners.append(json_of({corner[0] - centroid[0], corner[1] - centroid[1], corner[2] - centroid[2]}));
    active.append(cutter.begin);
    active.append(cutter.end);
    return json_object(
        {{"corners", corners}, {"active", active}, {"poses", poses_json(times, cutter.path.moves(), pose_at)}});
}

Json::Value space_json(const std::vector<ClothArrays>& cloths, const SceneDescription& scene, double megabytes) {
    const Kept kept = what_fits(cloths, scene, megabytes);
    Json::Value frames(Json::arrayValue), seconds(Json::arrayValue), list(Json::arrayValue);
    std::vector<double> times;
    for (const std::size_t frame : kept.frames) {
        frames.append(cloths.front().frames[frame]);
        seconds.append(cloths.front().times[frame]);
        times.push_back(cloths.front().times[frame]);
    }
    for (std::size_t i = 0; i < cloths.size(); ++i) list.append(cloth_json(cloths[i], scene.cloths[i], kept));
    const auto [width, height] = scene.image.size;
    const Camera camera = picture_camera(scene, width, height);
    return json_object(
        {{"frames", frames},
         {"frame_count", Json::Value::UInt64{cloths.front().frames.size()}},
         {"times", seconds},
         {"cloths", list},
         {"colors", json_array(viridis.colors, [](std::uint32_t color) { return Json::Value(color); })},
         {"colliders",
          json_array(scene.colliders, [&](const Collider& one) { return collider_json(one, times, kept.forms); })},
         {"cutters", json_array(scene.cutters, [&](const Cutter& one) { return cutter_json(one, times); })},
         {"camera", json_object({{"position", json_of(camera.position)},
                                 {"target", json_of(camera.target)},
                                 {"fov", camera.fov},
                                 {"aspect", static_cast<double>(width) / height}})}});
}

/// The cloths, in the scene's order.
std::vector<ClothArrays> read_cloths(const RunFolder& run, const std::string& archive, ClothArrays first,
                                     const SceneDescription& scene) {
    std::vector<ClothArrays> cloths;
    for (const Cloth& cloth : scene.cloths) {
        const bool is_only = scene.cloths.size() == 1;
        const std::string name = cloth_file_name("positions", {.name = is_only ? "" : cloth.name}, "npz");
        cloths.push_back(name == archive ? std::exchange(first, {}) : read_cloth_arrays(run.path / name));
        const ClothArrays& arrays = cloths.back();
        if (cloth.grid[0] != arrays.columns || cloth.grid[1] != arrays.rows || cloths[0].frames != arrays.frames)
            throw strange(run.path / name, "its positions are of another grid or of other frames");
    }
    return cloths;
}

/// JSON within a page that is XML, too: marks stand in strings alone, where they may be escaped.
std::string json_in_page(const Json::Value& value) {
    std::string text;
    for (const char c : json_line(value))
        text += c == '<' || c == '>' || c == '&' ? fmt::format("\\u{:04x}", static_cast<int>(c)) : std::string(1, c);
    return text;
}

}  // namespace

std::string space_view(const RunFolder& run, std::size_t id, double megabytes) {
    if (!(megabytes > 0)) return "<p>Left out, as --positions 0 asks.</p>\n";
    if (!run.is_finished) return "<p>A run writes its positions when it ends.</p>\n";
    const auto archive = std::ranges::find_if(
        run.files, [](const std::string& name) { return is_cloth_file_name(name, "positions", "npz"); });
    if (archive == run.files.end())
        return "<p>This run has no positions.npz, which a page shows in 3-D; <code>--export npz</code> writes "
               "it.</p>\n";
    ClothArrays first = read_cloth_arrays(run.path / *archive);
    // The scene in the archive names its files as the scene file did.
    const SceneResult result =
        read_scene_text(first.scene, *archive, {}, scene_folder(run.manifest["scene"]["path"].asString()));
    if (!result.scene)
        return fmt::format("<p>Not shown, since the run's scene cannot be read here and now: {}</p>\n",
                           xml_text(result.errors.front().text()));
    const SceneDescription& scene = *result.scene;
    const std::vector<ClothArrays> cloths = read_cloths(run, *archive, std::move(first), scene);
    if (cloths.front().frames.empty()) return "<p>No frame was written.</p>\n";
    return fmt::format(
        "<div class=\"space\" data-space=\"space{0}\">\n<div class=\"stage\"></div>\n<p class=\"controls\">"
        "<button type=\"button\">Play</button> <input type=\"range\" min=\"0\" max=\"0\" value=\"0\"/> "
        "<output></output> <label><input type=\"checkbox\" class=\"heat\"/> strain</label> "
        "<label><input type=\"checkbox\" class=\"wire\"/> triangles</label></p>\n<p class=\"legend\"></p>\n</div>\n"
        "<script type=\"application/json\" id=\"space{0}\">{1}</script>\n",
        id, json_in_page(space_json(cloths, scene, megabytes)));
}

}  // namespace drape::report
