#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "output/checkpoint_names.h"
#include "output/file_descriptor.h"
#include "output/kept_frames.h"
#include "output/output_folder.h"

namespace drape {

// A record is a frame that was passed to the writers, or a cut, in the order in which they received them.
struct JournalRecord {
    enum class Kind : std::uint32_t { frame, cut };
    Kind kind = Kind::frame;
    std::uint32_t frame = 0;
    FrameValues values{};  // only with a frame
    // Only with a frame, per cloth: x y z w of every particle; empty where no format needs them.
    std::vector<std::vector<float>> positions{}, velocities{}, tensions{}, contact_forces{};
    // Only with a cut.
    std::uint32_t cloth = 0, springs = 0, torn = 0, triangles = 0, pieces = 0, crumbs = 0;
    std::vector<std::uint32_t> faces{};
    std::vector<std::uint8_t> spring_bits{};
};

// Convert a record to and from bytes (engine/docs/checkpoint.md). decode_record throws Error when the bytes are no
// record.
std::vector<std::byte> encode_record(const JournalRecord& record);
JournalRecord decode_record(std::span<const std::byte> bytes);

// Keeps what the writers of a run received, so that a run that goes on from a checkpoint can pass the same to its own
// writers (whose arrays appear only when complete). Short runs never write the file: records wait in memory until there
// is a checkpoint or they become too many. From then on few wait, so that a run's memory does not depend on the number
// of frames between checkpoints. Every member throws OutputError.
class Journal {
  public:
    Journal(OutputFolder& folder, std::string run_key) : folder_(folder), run_key_(std::move(run_key)) {}

    void add(const JournalRecord& record);
    // Writes everything that was added to the disk, and returns the file's length.
    std::uint64_t sync();

    // Reads the records of the first `length` bytes, in order. Throws OutputError naming the file when it is not this
    // run's, or damaged.
    void read(std::uint64_t length, const std::function<void(JournalRecord&&)>& take) const;
    // Goes on after the first `length` bytes of the file, and removes what follows them.
    void go_on_behind(std::uint64_t length);

  private:
    void open_file(bool keep);
    void write_waiting();

    OutputFolder& folder_;
    std::string run_key_;
    FileDescriptor file_;
    std::uint64_t length_ = 0;  // bytes written
    std::vector<std::byte> waiting_;
};

}  // namespace drape
