#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "output/frame_table.h"
#include "output/frame_writer.h"
#include "output/npy.h"
#include "output/zip_file.h"

namespace drape {

namespace {

/// The values of all particles in all frames, which are collected in a file and then copied into the archive.
struct ParticleArray {
    std::string_view name;
    NpyValues values = {};
};
constexpr ParticleArray positions{"positions"}, velocities{"velocities"}, contacts{"contacts", {"<i2", 2, 1}};
constexpr ParticleArray tensions{tension_name, tension_values}, contact_forces{contact_force_name};
constexpr std::array<const ParticleArray*, 5> particle_arrays{&positions, &velocities, &contacts, &tensions,
                                                              &contact_forces};
constexpr std::size_t arrays_without_fields = 3;

/// Returns a cloth's values under its own names, and those of the frame's effort and of what was given, which are all
/// cloths'.
FrameValues numbers_of(const FrameValues& values, const std::string& label) {
    const std::string own = label + "/";
    FrameValues numbers;
    for (const auto& [name, value] : values) {
        if (name.starts_with(own)) numbers[name.substr(own.size())] = value;
        for (const std::string_view effort :
             {"substeps", "attempts", "motion_error_m_s", "motion_allowed_m_s", "position_error_m",
              "position_error_at_end_m", "position_allowed_m", "parted_m", "sensitive", "asleep"})
            if (name == effort) numbers[name] = value;
        if (name.starts_with("failed_") || name.starts_with("given_") || name.starts_with("body_"))
            numbers[name] = value;
    }
    return numbers;
}

template <class T>
std::string list_array(const char* type, const std::vector<T>& values) {
    return npy_array(type, fmt::format("{},", values.size()), std::as_bytes(std::span(values)));
}

/// The archive of one cloth. Its frames are collected in files beside it, because the parts of a ZIP cannot grow in
/// parallel.
class NpzFile {
  public:
    NpzFile(OutputFolder& folder, const WrittenRun& run, const WrittenCloth& cloth)
        : folder_(folder), run_(run), cloth_(cloth), numbers_(folder) {
        for (std::size_t i = 0; i < array_count(); ++i) {
            const ParticleArray& array = *particle_arrays[i];
            waiting_[i] = std::make_unique<NpyWriter>(folder, cloth_file_name(waiting_stem(array), cloth, "npz"),
                                                      run.frame_count(), cloth.rows, cloth.columns, array.values);
        }
    }

    /// Frames are collected in a file that never appears under this name.
    static std::string waiting_stem(const ParticleArray& array) { return fmt::format("frames_of_{}", array.name); }

    void add(const WrittenFrame& frame, std::size_t cloth) {
        waiting_[0]->append_frame_xyzw(frame.positions[cloth]);
        waiting_[1]->append_frame_xyzw(frame.velocities[cloth]);
        waiting_[2]->append_bytes(std::as_bytes(frame.contacts[cloth]));
        if (run_.fields) {
            waiting_[3]->append_bytes(std::as_bytes(frame.tensions[cloth]));
            waiting_[4]->append_frame_xyzw(frame.contact_forces[cloth]);
        }
        numbers_.add(frame.number, numbers_of(frame.values, cloth_.label));
    }

    void set_faces(std::uint32_t frame, const std::vector<std::uint32_t>& faces) {
        cut_faces_.emplace_back(fmt::format("faces_{:04}.npy", frame), face_array(faces));
    }

    void set_springs(std::uint32_t frame, const std::vector<std::uint8_t>& springs) {
        cut_faces_.emplace_back(fmt::format("{}_{:04}.npy", springs_name, frame), springs_array(springs));
    }

    FileRecord finish() {
        ZipFile archive(folder_, cloth_file_name("positions", cloth_, "npz"), run_.deflates);
        for (std::size_t i = 0; i < array_count(); ++i)
            archive.add(fmt::format("{}.npy", particle_arrays[i]->name), waiting_[i]->contents());
        archive.add("faces.npy", face_array(cloth_.faces));
        if (!cloth_.springs.empty()) archive.add(fmt::format("{}.npy", springs_name), springs_array(cloth_.springs));
        for (const auto& [name, array] : cut_faces_) archive.add(name, array);
        archive.add("uv.npy", uv_array());
        const std::vector<std::uint32_t> numbers = numbers_.frames();
        archive.add("frames.npy", list_array("<i8", std::vector<std::int64_t>(numbers.begin(), numbers.end())));
        std::vector<double> times;
        for (const std::uint32_t number : numbers) times.push_back(number / run_.fps);
        archive.add("times.npy", list_array("<f8", times));
        for (const std::string& name : numbers_.names())
            archive.add(name + ".npy", list_array("<f8", numbers_.column(name)));
        const std::int64_t seed = run_.seed;
        archive.add("seed.npy", npy_array("<i8", "", std::as_bytes(std::span(&seed, 1))));
        for (const auto& [name, array] : run_.set) archive.add(name + ".npy", array);
        archive.add("parameters.npy", text_array(run_.parameters));
        archive.add("scene.npy", text_array(run_.scene));
        return archive.commit();
    }

  private:
    std::size_t array_count() const { return run_.fields ? particle_arrays.size() : arrays_without_fields; }
    std::string springs_array(const std::vector<std::uint8_t>& springs) const {
        return npy_array("|u1", fmt::format("{}, {}", cloth_.rows, cloth_.columns), std::as_bytes(std::span(springs)));
    }
    std::string uv_array() const {
        std::vector<std::array<float, 2>> uv;
        for (std::size_t particle = 0; particle < cloth_.particle_count(); ++particle)
            uv.push_back(cloth_.uv(particle));
        return npy_array("<f4", fmt::format("{}, {}, 2", cloth_.rows, cloth_.columns), std::as_bytes(std::span(uv)));
    }

    OutputFolder& folder_;
    const WrittenRun& run_;
    WrittenCloth cloth_;
    std::array<std::unique_ptr<NpyWriter>, particle_arrays.size()> waiting_;
    std::vector<std::pair<std::string, std::string>> cut_faces_;  ///< and springs: name, array
    FrameTable numbers_;
};

class NpzFiles : public FrameWriter {
  public:
    NpzFiles(OutputFolder& folder, const WrittenRun& run) : run_(run) {
        for (const WrittenCloth& cloth : run_.cloths)
            archives_.push_back(std::make_unique<NpzFile>(folder, run_, cloth));
    }

    void add(const WrittenFrame& frame) override {
        for (std::size_t cloth = 0; cloth < archives_.size(); ++cloth) archives_[cloth]->add(frame, cloth);
    }

    void set_faces(std::uint32_t frame, std::size_t cloth, const std::vector<std::uint32_t>& faces) override {
        archives_[cloth]->set_faces(frame, faces);
    }
    void set_springs(std::uint32_t frame, std::size_t cloth, const std::vector<std::uint8_t>& springs) override {
        archives_[cloth]->set_springs(frame, springs);
    }

    std::vector<FileRecord> finish() override {
        std::vector<FileRecord> files;
        for (const auto& archive : archives_) files.push_back(archive->finish());
        return files;
    }

  private:
    WrittenRun run_;
    std::vector<std::unique_ptr<NpzFile>> archives_;
};

bool owns(std::string_view name) {
    return is_cloth_file_name(name, "positions", "npz") ||
           std::ranges::any_of(particle_arrays, [name](const ParticleArray* array) {
               return is_cloth_file_name(name, NpzFile::waiting_stem(*array), "npz");
           });
}

}  // namespace

extern const OutputFormat npz_format{
    .name = "npz",
    .files = "positions.npz",
    .holds =
        "positions as in npy; velocities likewise, m/s; contacts [frame, row, column], the number of the collider "
        "that a particle touches, or -1; faces [face, 3], after a cut faces_FRAME, from that frame on; uv [row, "
        "column, 2]; with cuts, tears or \"forces\": \"fields\" springs [row, column], after a cut springs_FRAME, bits "
        "of the springs that are there, 1 for that to the right (column + 1), 2 down (row + 1), 4 down right, 8 down "
        "left; with \"fields\" tension [frame, row, column, 4], N, what these four bear, and contact_force [frame, "
        "row, "
        "column, 3], N, of colliders and cloth, the frame's mean; frames and times (s) [frame]; the manifest's numbers "
        "of each "
        "frame, stretch_error_rms, "
        "kinetic_energy_j and so on [frame]; what was given to each frame, given_wind_x_m_s and so on [frame]; what "
        "overrides set, set/POINTER; seed, of the gusts; parameters, what the run chose, and scene, with "
        "every default, JSON",
    .details = true,
    .is_archive = true,
    .frame_files = false,
    .frame_bytes = [](const FrameSize& frame) { return (frame.packed ? 1 : 2) * 26 * frame.particles; },
    .owns = owns,
    .open = open_writer<NpzFiles>};

}  // namespace drape
