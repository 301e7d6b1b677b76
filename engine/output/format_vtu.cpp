// VTK's unstructured grids (https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html) are XML whose arrays
// are appended as they lie in memory; a collection gives each file its time.
#include <fmt/format.h>

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

std::string vtu_text(const WrittenCloth& cloth, const WrittenMesh& mesh) {
    constexpr std::uint8_t triangle = 5;
    const std::size_t triangles = cloth.faces.size() / 3;
    std::vector<float> uv;
    for (std::size_t particle = 0; particle < cloth.particle_count(); ++particle)
        for (const float coordinate : cloth.uv(particle)) uv.push_back(coordinate);
    std::vector<std::int64_t> corners(cloth.faces.begin(), cloth.faces.end()), ends;
    for (std::size_t i = 1; i <= triangles; ++i) ends.push_back(static_cast<std::int64_t>(3 * i));
    Appended data;
    std::string text = fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
        cloth.particle_count(), triangles);
    text += "<PointData Vectors=\"velocity\" TCoords=\"uv\">\n";
    text += data.array("Float32", "velocity", 3, without_w(mesh.velocities));
    text += data.array("Int16", "contact", 1, std::vector<std::int16_t>(mesh.contacts.begin(), mesh.contacts.end()));
    text += data.array("Float32", "uv", 2, uv);
    text += "</PointData>\n<Points>\n";
    text += data.array("Float32", "points", 3, without_w(mesh.positions));
    text += "</Points>\n<Cells>\n";
    text += data.array("Int64", "connectivity", 1, corners);
    text += data.array("Int64", "offsets", 1, ends);
    text += data.array("UInt8", "types", 1, std::vector<std::uint8_t>(triangles, triangle));
    text += "</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
    return text + data.bytes() + "\n</AppendedData>\n</VTKFile>\n";
}

constexpr std::string_view collection_name = "mesh.pvd";

class VtuSequence : public MeshSequence {
  public:
    VtuSequence(OutputFolder& folder, const WrittenRun& run) : MeshSequence(folder, run, "vtu", vtu_text) {}

    void add(const WrittenFrame& frame) override {
        const std::size_t before = files().size();
        MeshSequence::add(frame);
        for (std::size_t part = 0; before + part < files().size(); ++part)
            collection_ += fmt::format("<DataSet timestep=\"{}\" part=\"{}\" file=\"{}\"/>\n", frame.number / run().fps,
                                       part, files()[before + part].name);
    }

    std::vector<FileRecord> finish() override {
        const std::string text =
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
            "<Collection>\n" +
            collection_ + "</Collection>\n</VTKFile>\n";
        const FileRecord collection = write_file(folder(), std::string(collection_name), bytes_of(text));
        std::vector<FileRecord> all = MeshSequence::finish();
        all.push_back(collection);
        return all;
    }

  private:
    std::string collection_;
};

}  // namespace

extern const OutputFormat vtu_format{
    .name = "vtu",
    .files = "mesh_FRAME.vtu, mesh.pvd",
    .holds =
        "VTK grids of triangles with velocity (m/s), contact and uv of every particle; mesh.pvd gives them their "
        "times",
    .details = true,
    .frame_files = true,
    .frame_bytes = [](const FrameSize& frame) { return 34 * frame.particles + 33 * frame.triangles; },
    .owns =
        [](std::string_view name) { return is_cloth_frame_file_name(name, "mesh", "vtu") || name == collection_name; },
    .open = open_writer<VtuSequence>};

}  // namespace drape
