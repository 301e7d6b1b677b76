#include "output/frame_writer.h"
#include "output/npy.h"

namespace drape {

namespace {

class NpyFiles : public FrameWriter {
  public:
    NpyFiles(OutputFolder& folder, const WrittenRun& run) : folder_(folder), run_(run) {
        for (std::size_t cloth = 0; cloth < run_.cloths.size(); ++cloth) {
            const WrittenCloth& written = run_.cloths[cloth];
            if (run_.cuts) set_faces(0, cloth, written.faces);
            arrays_.push_back(std::make_unique<NpyWriter>(folder, cloth_file_name("positions", written, "npy"),
                                                          run_.frame_count(), written.rows, written.columns));
            if (!run_.fields) continue;
            tensions_.push_back(std::make_unique<NpyWriter>(folder, cloth_file_name(tension_name, written, "npy"),
                                                            run_.frame_count(), written.rows, written.columns,
                                                            tension_values));
            contacts_.push_back(std::make_unique<NpyWriter>(folder, cloth_file_name(contact_force_name, written, "npy"),
                                                            run_.frame_count(), written.rows, written.columns));
        }
    }

    void add(const WrittenFrame& frame) override {
        for (std::size_t cloth = 0; cloth < arrays_.size(); ++cloth)
            arrays_[cloth]->append_frame_xyzw(frame.positions[cloth]);
        for (std::size_t cloth = 0; cloth < tensions_.size(); ++cloth) {
            tensions_[cloth]->append_bytes(std::as_bytes(frame.tensions[cloth]));
            contacts_[cloth]->append_frame_xyzw(frame.contact_forces[cloth]);
        }
    }

    void set_faces(std::uint32_t frame, std::size_t cloth, const std::vector<std::uint32_t>& faces) override {
        const std::string name = cloth_frame_file_name("faces", run_.cloths[cloth], frame, frame_digits(0), "npy");
        files_.push_back(write_file(folder_, name, bytes_of(face_array(faces))));
    }

    std::vector<FileRecord> finish() override {
        for (const auto* const arrays : {&arrays_, &tensions_, &contacts_})
            for (const auto& array : *arrays) files_.push_back(array->finish());
        return std::move(files_);
    }

  private:
    OutputFolder& folder_;
    WrittenRun run_;
    std::vector<std::unique_ptr<NpyWriter>> arrays_, tensions_, contacts_;  ///< the latter two: only of fields
    std::vector<FileRecord> files_;
};

}  // namespace

extern const OutputFormat npy_format{.name = "npy",
                                     .files = "positions.npy, tension.npy, contact_force.npy",
                                     .holds =
                                         "positions, float32 [frame, row, column, 3], metres; with cuts "
                                         "faces_FRAME.npy too, int32 [face, 3], from that frame on; with \"forces\": "
                                         "\"fields\" the others, as in npz",
                                     .frame_files = false,
                                     .frame_bytes = [](const FrameSize& frame) { return 12 * frame.particles; },
                                     .owns =
                                         [](std::string_view name) {
                                             return is_cloth_file_name(name, "positions", "npy") ||
                                                    is_cloth_file_name(name, tension_name, "npy") ||
                                                    is_cloth_file_name(name, contact_force_name, "npy") ||
                                                    is_cloth_frame_file_name(name, "faces", "npy");
                                         },
                                     .open = open_writer<NpyFiles>};

}  // namespace drape
