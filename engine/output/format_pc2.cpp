// Point cache 2 (http://mattebb.com/projects/bpython/pointcache/pc2.html) is a header of 32 bytes, then x y z of every
// point, sample by sample. Blender, Maya and 3ds Max play it on the mesh beside it, whose vertices must keep their
// order.
#include <algorithm>
#include <bit>

#include "output/frame_writer.h"
#include "output/mesh_text.h"

namespace drape {

static_assert(std::endian::native == std::endian::little, "samples are written as they lie in memory");

namespace {

struct Pc2Header {
    char signature[12] = {'P', 'O', 'I', 'N', 'T', 'C', 'A', 'C', 'H', 'E', '2', 0};
    std::int32_t version = 1, point_count = 0;
    float start_frame = 0, sample_step = 1;  ///< frames
    std::int32_t sample_count = 0;
};
static_assert(sizeof(Pc2Header) == 32);

/// Returns the particles of any triangle: importers drop other vertices, and the rest would no longer fit.
std::vector<std::uint32_t> used_particles(const WrittenCloth& cloth) {
    std::vector<std::uint32_t> used = cloth.faces;
    std::ranges::sort(used);
    const auto rest = std::ranges::unique(used);
    used.erase(rest.begin(), rest.end());
    return used;
}

class Pc2Files {
  public:
    Pc2Files(OutputFolder& folder, const WrittenRun& run, const WrittenCloth& cloth)
        : folder_(folder),
          cloth_(cloth),
          particles_(used_particles(cloth)),
          cache_(folder, cloth_file_name("positions", cloth, "pc2")) {
        header_.point_count = static_cast<std::int32_t>(particles_.size());
        header_.start_frame = static_cast<float>(run.start);
        header_.sample_step = static_cast<float>(run.step);
        cache_.append(std::as_bytes(std::span(&header_, 1)));
    }

    void add(std::span<const float> xyzw) {
        if (header_.sample_count++ == 0) mesh_ = obj_text(cloth_, xyzw, particles_);
        std::vector<std::array<float, 3>> sample;
        for (const std::size_t particle : particles_)
            sample.push_back({xyzw[4 * particle], xyzw[4 * particle + 1], xyzw[4 * particle + 2]});
        cache_.append(std::as_bytes(std::span(sample)));
    }

    void finish(std::vector<FileRecord>& files) {
        cache_.rewrite(0, std::as_bytes(std::span(&header_, 1)));
        files.push_back(cache_.commit());
        files.push_back(write_file(folder_, cloth_file_name("positions", cloth_, "obj"), bytes_of(mesh_)));
    }

  private:
    OutputFolder& folder_;
    WrittenCloth cloth_;
    std::vector<std::uint32_t> particles_;
    Pc2Header header_;
    AtomicFile cache_;
    std::string mesh_;
};

class Pc2Writer : public FrameWriter {
  public:
    Pc2Writer(OutputFolder& folder, const WrittenRun& run) {
        for (const WrittenCloth& cloth : run.cloths) cloths_.push_back(std::make_unique<Pc2Files>(folder, run, cloth));
    }

    void add(const WrittenFrame& frame) override {
        for (std::size_t cloth = 0; cloth < cloths_.size(); ++cloth) cloths_[cloth]->add(frame.positions[cloth]);
    }

    std::vector<FileRecord> finish() override {
        std::vector<FileRecord> files;
        for (const auto& cloth : cloths_) cloth->finish(files);
        return files;
    }

  private:
    std::vector<std::unique_ptr<Pc2Files>> cloths_;
};

}  // namespace

extern const OutputFormat pc2_format{
    .name = "pc2",
    .files = "positions.pc2, positions.obj",
    .holds = "a point cache, and the uncut mesh in its first frame to play it on",
    .frame_files = false,
    .frame_bytes = [](const FrameSize& frame) { return frame.triangles > 0 ? 12 * frame.particles : 0; },
    .owns =
        [](std::string_view name) {
            return is_cloth_file_name(name, "positions", "pc2") || is_cloth_file_name(name, "positions", "obj");
        },
    .open = open_writer<Pc2Writer>};

}  // namespace drape
