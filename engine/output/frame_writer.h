// What a run writes its frames as: one file per format (format_*.cpp), which owns its file names, and one table of them
// (output_formats.cpp).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "output/atomic_file.h"
#include "output/kept_frames.h"

namespace drape {

/// A cloth as its files describe it. Particles are numbered row * columns + column, before and after any cut.
struct WrittenCloth {
    std::string name;  ///< for its files' names; empty when it is the only one
    std::uint32_t columns = 0, rows = 0;
    std::vector<std::uint32_t> faces;  ///< three particles per triangle, uncut

    std::size_t particle_count() const { return std::size_t{columns} * rows; }
    /// Where the particle is in the cloth, 0 .. 1: along the columns, and from the last row up to row 0.
    std::array<float, 2> uv(std::size_t particle) const;
};

struct WrittenRun {
    std::vector<WrittenCloth> cloths;
    std::uint32_t start = 0, end = 0, step = 1;  ///< frames, `end` inclusive
    double fps = 60;
    bool cuts = false;  ///< faces may change
    std::uint32_t width = 0, height = 0;
    std::string key;  ///< kept_frames.h

    std::uint32_t frame_count() const { return (end - start) / step + 1; }
};

/// Valid during FrameWriter::add. What the format does not need may be empty.
struct WrittenFrame {
    std::uint32_t number = 0;
    std::span<const std::uint8_t> rgba;             ///< rows from the top, sRGB
    std::vector<std::span<const float>> positions;  ///< per cloth: x y z (m) and w per particle
    FrameValues values;
};

/// Writes the frames of a run into its folder; for one thread. Every member throws OutputError; files appear whole or
/// not at all, and what is not finished leaves nothing but the files of single frames.
class FrameWriter {
  public:
    FrameWriter() = default;
    FrameWriter(const FrameWriter&) = delete;
    FrameWriter& operator=(const FrameWriter&) = delete;
    virtual ~FrameWriter() = default;

    /// In order of frames.
    virtual void add(const WrittenFrame& frame) = 0;
    /// From `frame` on, which was not added yet, these are the cloth's triangles: those that no cut has split.
    virtual void set_faces(std::uint32_t frame, std::size_t cloth, const std::vector<std::uint32_t>& faces) {
        (void)frame, (void)cloth, (void)faces;
    }
    /// The files written, of the frames added so far. Nothing may be added after.
    virtual std::vector<FileRecord> finish() = 0;
};

struct OutputFormat {
    std::string_view name;  ///< of --export
    std::string_view help;  ///< files and what they hold, in lines of at most 79 characters
    bool draws = false;     ///< needs WrittenFrame::rgba, else positions
    bool resumes = false;   ///< its files say which run they are of (kept_frames.h); others' are written anew
    bool frame_files;       ///< a file per frame, each a result; else files that appear when the run is complete
    /// Whether the format may give a file this name.
    bool (*owns)(std::string_view file_name);
    /// The folder must outlive the writer.
    std::unique_ptr<FrameWriter> (*open)(OutputFolder& folder, const WrittenRun& run);
};

template <class Writer>
std::unique_ptr<FrameWriter> open_writer(OutputFolder& folder, const WrittenRun& run) {
    return std::make_unique<Writer>(folder, run);
}

std::span<const OutputFormat* const> output_formats();
/// Nothing when there is none of that name.
const OutputFormat* find_output_format(std::string_view name);
/// "npy, npz, ...": those that need no picture.
std::string undrawn_format_names();

/// Digits of the frame numbers in file names: enough for the last frame, at least four.
int frame_digits(std::uint64_t last_frame);

/// "positions.npy", or "positions_flag.npy" for one of several cloths.
std::string cloth_file_name(std::string_view stem, const WrittenCloth& cloth, std::string_view extension);
bool is_cloth_file_name(std::string_view name, std::string_view stem, std::string_view extension);

/// "mesh_0031.obj", or "mesh_flag_0031.obj" for one of several cloths.
std::string cloth_frame_file_name(std::string_view stem, const WrittenCloth& cloth, std::uint64_t frame, int digits,
                                  std::string_view extension);
bool is_cloth_frame_file_name(std::string_view name, std::string_view stem, std::string_view extension);

}  // namespace drape
