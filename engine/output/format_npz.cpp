#include <fmt/format.h>

#include "output/frame_writer.h"
#include "output/npy.h"
#include "output/zip_file.h"

namespace drape {

namespace {

/// The frames wait in a file beside the archive, as a ZIP's parts cannot grow side by side.
class NpzFiles : public FrameWriter {
  public:
    NpzFiles(OutputFolder& folder, const WrittenRun& run) : folder_(folder), run_(run), cut_faces_(run.cloths.size()) {
        for (const WrittenCloth& cloth : run_.cloths)
            positions_.push_back(std::make_unique<NpyWriter>(folder, cloth_file_name("frames", cloth, "npz"),
                                                             run_.frame_count(), cloth.rows, cloth.columns));
    }

    void add(const WrittenFrame& frame) override {
        for (std::size_t cloth = 0; cloth < positions_.size(); ++cloth)
            positions_[cloth]->append_frame_xyzw(frame.positions[cloth]);
        times_.push_back(frame.number / run_.fps);
    }

    void set_faces(std::uint32_t frame, std::size_t cloth, const std::vector<std::uint32_t>& faces) override {
        cut_faces_[cloth].emplace_back(fmt::format("faces_{:04}.npy", frame), face_array(faces));
    }

    std::vector<FileRecord> finish() override {
        std::vector<FileRecord> files;
        for (std::size_t i = 0; i < positions_.size(); ++i) {
            const WrittenCloth& cloth = run_.cloths[i];
            ZipFile archive(folder_, cloth_file_name("positions", cloth, "npz"));
            archive.add("positions.npy", positions_[i]->contents());
            archive.add("faces.npy", face_array(cloth.faces));
            for (const auto& [name, array] : cut_faces_[i]) archive.add(name, array);
            archive.add("uv.npy", uv_array(cloth));
            archive.add("times.npy",
                        npy_array("<f8", fmt::format("{},", times_.size()), std::as_bytes(std::span(times_))));
            files.push_back(archive.commit());
        }
        return files;
    }

  private:
    static std::string uv_array(const WrittenCloth& cloth) {
        std::vector<std::array<float, 2>> uv;
        for (std::size_t particle = 0; particle < cloth.particle_count(); ++particle) uv.push_back(cloth.uv(particle));
        return npy_array("<f4", fmt::format("{}, {}, 2", cloth.rows, cloth.columns), std::as_bytes(std::span(uv)));
    }

    OutputFolder& folder_;
    WrittenRun run_;
    std::vector<std::unique_ptr<NpyWriter>> positions_;
    std::vector<std::vector<std::pair<std::string, std::string>>> cut_faces_;  ///< per cloth: name, array
    std::vector<double> times_;                                                ///< s
};

}  // namespace

extern const OutputFormat npz_format{.name = "npz",
                                     .help =
                                         "positions.npz: positions as above, faces [face, 3], uv [row, column, 2],\n"
                                         "times [frame], seconds; after a cut faces_FRAME, from that frame on",
                                     .frame_files = false,
                                     .owns =
                                         [](std::string_view name) {
                                             return is_cloth_file_name(name, "positions", "npz") ||
                                                    is_cloth_file_name(name, "frames", "npz");
                                         },
                                     .open = open_writer<NpzFiles>};

}  // namespace drape
