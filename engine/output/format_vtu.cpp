// VTK's unstructured grids (https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html) are XML whose arrays
// are appended as they lie in memory; a collection gives each file its time.
#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "output/mesh_text.h"
#include "output/npy.h"

namespace drape {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

namespace {

/// The XML of a file's arrays, and their bytes.
class Appended {
  public:
    template <class T>
    std::string array(const char* type, const char* name, int components, const std::vector<T>& values) {
        std::string element = fmt::format(
            "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" "
            "offset=\"{}\"/>\n",
            type, name, components, bytes_.size());
        const std::uint64_t count = values.size() * sizeof(T);
        bytes_.append(reinterpret_cast<const char*>(&count), sizeof count);
        bytes_.append(reinterpret_cast<const char*>(values.data()), count);
        return element;
    }
    const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
};

/// Returns a grid of triangles; `attributes` are elements whose arrays `data` has.
std::string grid_text(Appended& data, const std::string& attributes, const std::vector<float>& points,
                      const std::vector<std::uint32_t>& faces) {
    constexpr std::uint8_t triangle = 5;
    const std::size_t triangles = faces.size() / 3;
    const std::vector<std::int64_t> corners(faces.begin(), faces.end());
    std::vector<std::int64_t> ends;
    for (std::size_t i = 1; i <= triangles; ++i) ends.push_back(static_cast<std::int64_t>(3 * i));
    std::string text = fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
        points.size() / 3, triangles);
    text += attributes + "<Points>\n";
    text += data.array("Float32", "points", 3, points);
    text += "</Points>\n<Cells>\n";
    text += data.array("Int64", "connectivity", 1, corners);
    text += data.array("Int64", "offsets", 1, ends);
    text += data.array("UInt8", "types", 1, std::vector<std::uint8_t>(triangles, triangle));
    text += "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
    return text + data.bytes() + "\n</AppendedData>\n</VTKFile>\n";
}

std::string vtu_text(const WrittenCloth& cloth, const WrittenMesh& mesh) {
    std::vector<float> uv;
    for (std::size_t particle = 0; particle < cloth.particle_count(); ++particle)
        for (const float coordinate : cloth.uv(particle)) uv.push_back(coordinate);
    Appended data;
    std::string text = "<PointData Vectors=\"velocity\" TCoords=\"uv\">\n";
    text += data.array("Float32", "velocity", 3, without_w(mesh.velocities));
    text += data.array("Int16", "contact", 1, std::vector<std::int16_t>(mesh.contacts.begin(), mesh.contacts.end()));
    text += data.array("Float32", "uv", 2, uv);
    if (!cloth.springs.empty()) text += data.array("UInt8", "springs", 1, cloth.springs);
    if (!mesh.tensions.empty())
        text += data.array("Float32", "tension", 4, std::vector<float>(mesh.tensions.begin(), mesh.tensions.end()));
    if (!mesh.contact_forces.empty()) text += data.array("Float32", "contact_force", 3, without_w(mesh.contact_forces));
    return grid_text(data, text + "</PointData>\n", without_w(mesh.positions), cloth.faces);
}

std::string vtu_colliders_text(const std::vector<PlacedCollider>& colliders, Up) {
    std::vector<std::int32_t> numbers;
    for (const auto& [collider, vertices] : colliders)
        numbers.insert(numbers.end(), collider.faces.size() / 3, collider.number);
    Appended data;
    std::string text = "<CellData Scalars=\"collider\">\n" + data.array("Int32", "collider", 1, numbers);
    return grid_text(data, text + "</CellData>\n", joined_vertices(colliders), joined_faces(colliders));
}

constexpr std::string_view collection_name = "mesh.pvd", colliders_collection_name = "colliders.pvd";

/// Gives each file of a frame its time.
class Collection {
  public:
    void add(double time, std::size_t part, const std::string& file) {
        sets_ += fmt::format("<DataSet timestep=\"{}\" part=\"{}\" file=\"{}\"/>\n", time, part, file);
    }
    FileRecord write(OutputFolder& folder, std::string_view name) const {
        const std::string text =
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
            "<Collection>\n" +
            sets_ + "</Collection>\n</VTKFile>\n";
        return write_file(folder, std::string(name), bytes_of(text));
    }

  private:
    std::string sets_;
};

class VtuSequence : public FaceSequence {
  public:
    VtuSequence(OutputFolder& folder, const WrittenRun& run)
        : FaceSequence(folder, run, "vtu", {vtu_text, vtu_colliders_text}) {}

    void add(const WrittenFrame& frame) override {
        const std::size_t before = files().size();
        FaceSequence::add(frame);
        const double time = frame.number / run().fps;
        const std::size_t cloths = run().cloths.size();
        for (std::size_t part = 0; part < cloths; ++part) cloths_.add(time, part, files()[before + part].name);
        // A file of colliders that stand still is every frame's.
        std::size_t part = 0;
        for (const bool moving : {false, true}) {
            if (std::ranges::count(run().colliders, moving, &WrittenCollider::moves) == 0) continue;
            const int digits = frame_digits(run().end);
            colliders_.add(time, part++,
                           moving ? moving_colliders_name(frame.number, digits, "vtu") : still_colliders_name("vtu"));
        }
    }

    std::vector<FileRecord> finish() override {
        std::vector<FileRecord> all = FaceSequence::finish();
        all.push_back(cloths_.write(folder(), collection_name));
        if (!run().colliders.empty()) all.push_back(colliders_.write(folder(), colliders_collection_name));
        return all;
    }

  private:
    Collection cloths_, colliders_;
};

}  // namespace

extern const OutputFormat vtu_format{
    .name = "vtu",
    .files = "mesh_FRAME.vtu, mesh.pvd, colliders.vtu, colliders_FRAME.vtu, colliders.pvd",
    .holds =
        "VTK grids of triangles with velocity (m/s), contact and uv of every particle, and what NPZ has of springs and "
        "forces (springs, tension, contact_force); mesh.pvd gives them their times; colliders likewise, with the "
        "number that contact has; colliders.pvd",
    .details = true,
    .frame_files = true,
    .frame_bytes =
        [](const FrameSize& frame) {
            return 34 * frame.particles + 33 * frame.triangles + 12 * frame.moving_vertices +
                   37 * frame.moving_triangles;
        },
    .owns =
        [](std::string_view name) {
            return is_cloth_frame_file_name(name, "mesh", "vtu") || is_colliders_name(name, "vtu") ||
                   name == collection_name || name == colliders_collection_name;
        },
    .open = open_writer<VtuSequence>};

}  // namespace drape
