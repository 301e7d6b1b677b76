// The formats in which a run writes its frames. Each format has one file (format_*.cpp), which defines its file names,
// and a row in one table (output_formats.cpp).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drape/frame.h"
#include "drape/scene.h"
#include "output/atomic_file.h"
#include "output/kept_frames.h"
#include "output/written_collider.h"

namespace drape {

/// A cloth as its files describe it. Particles are numbered row * columns + column, before and after any cut.
struct WrittenCloth {
    std::string name;  ///< part of its files' names; empty when it is the only one
    std::uint32_t columns = 0, rows = 0;
    std::vector<std::uint32_t> faces;  ///< three particles per triangle, uncut
    std::string label = {};            ///< its name in the scene: WrittenFrame::values has "<label>/..."
    std::array<double, 2> size{1, 1};  ///< metres along columns, rows
    std::vector<bool> held{};          ///< by particle: pinned at the start; empty: none
    Up up = Up::y;                     ///< of the world in whose coordinates the files are
    /// m: where each particle lies on the flat cloth of an outline (Cloth::panel); empty: on the grid.
    std::vector<std::array<double, 2>> panel{};
    std::vector<std::uint8_t> springs{};  ///< Simulation::spring_bits; empty: they are not written

    std::size_t particle_count() const { return std::size_t{columns} * rows; }
    /// Returns where the particle is in the cloth, 0 .. 1: along the columns, and from the last row up to row 0.
    std::array<float, 2> uv(std::size_t particle) const;
};

/// Where bodies that cloth moves are, by frame, as far as the run has come.
using BodyTracks = std::map<std::uint32_t, std::vector<BodyState>>;

struct WrittenRun {
    std::vector<WrittenCloth> cloths;
    std::uint32_t start = 0, end = 0, step = 1;  ///< frames, `end` inclusive
    double fps = 60;
    bool cuts = false;      ///< faces may change
    bool deflates = false;  ///< archives are compressed
    Up up = Up::y;          ///< of the world in whose coordinates the files are
    std::uint32_t width = 0, height = 0;
    bool alpha = false;             ///< pictures have an alpha channel
    std::string key;                ///< the run's key (kept_frames.h)
    std::string scene, parameters;  ///< JSON: the scene with its defaults written out; the run's choices
    std::uint32_t seed = 0;         ///< determines the gusts
    std::vector<std::pair<std::string, std::string>> set =
        {};  ///< name and NPY text of what overrides gave (set_arrays)
    /// Filled with each frame before the writers get it; the colliders' placements look there.
    std::shared_ptr<BodyTracks> bodies = std::make_shared<BodyTracks>();
    std::vector<WrittenCollider> colliders = {};
    std::vector<WrittenCollider> obstacles = {};  ///< the same colliders for graph networks, which know only nodes
    bool fields = false;                          ///< frames have tensions and contact forces

    std::uint32_t frame_count() const { return (end - start) / step + 1; }
};

/// The data of a frame, valid during FrameWriter::add. Data that the format does not need may be empty.
struct WrittenFrame {
    std::uint32_t number = 0;
    std::span<const std::uint8_t> rgba;                   ///< rows from the top, sRGB
    std::vector<std::span<const float>> positions;        ///< per cloth: x y z (m) and w per particle
    std::vector<std::span<const float>> velocities;       ///< per cloth: x y z (m/s) and 0 per particle
    std::vector<std::span<const std::int16_t>> contacts;  ///< per cloth: the collider that a particle touches, or -1
    FrameValues values;
    std::span<const LayerPixel> layers = {};  ///< of the picture's size, rows from the top
    std::vector<std::span<const float>> tensions = {}, contact_forces = {};  ///< per cloth: of FinishedFrame
};

/// Writes the frames of a run into its folder; for use by one thread. Every member throws OutputError. Files appear
/// complete or not at all; an unfinished writer leaves only the files of single frames.
class FrameWriter {
  public:
    FrameWriter() = default;
    FrameWriter(const FrameWriter&) = delete;
    FrameWriter& operator=(const FrameWriter&) = delete;
    virtual ~FrameWriter() = default;

    /// Adds frames in their order.
    virtual void add(const WrittenFrame& frame) = 0;
    /// From `frame` on, which has not been added yet, the cloth has these triangles, which no cut has split.
    virtual void set_faces(std::uint32_t frame, std::size_t cloth, const std::vector<std::uint32_t>& faces) {
        (void)frame, (void)cloth, (void)faces;
    }
    /// Likewise the springs that are there from `frame` on (WrittenCloth::springs).
    virtual void set_springs(std::uint32_t frame, std::size_t cloth, const std::vector<std::uint8_t>& springs) {
        (void)frame, (void)cloth, (void)springs;
    }
    /// Waits until the files of the single frames added so far are whole.
    virtual void flush() {}
    /// Returns the files written for the frames added so far. Nothing may be added after.
    virtual std::vector<FileRecord> finish() = 0;
};

/// Takes a stream's bytes in order; may throw, which ends the run.
using ByteSink = std::function<void(std::span<const std::byte>)>;

/// The size of a run's frames, all cloths together.
struct FrameSize {
    std::uint64_t particles = 0;
    std::uint64_t triangles = 0;  ///< 0: holes or cuts leave fewer
    std::uint64_t pixels = 0;
    std::uint64_t moving_vertices = 0, moving_triangles = 0;  ///< of colliders that move
    std::uint64_t obstacle_nodes = 0;                         ///< nodes of colliders for graph networks
    bool packed = false;  ///< archives take less space than the data that waits for them
};

/// A row of the table. The command line's help, the check of its options, docs/export_formats.md (usage_test) and the
/// names that `--overwrite` may remove follow from these.
struct OutputFormat {
    std::string_view name;     ///< value of --export
    std::string_view files;    ///< "positions.npy": with one cloth; FRAME stands for at least four digits
    std::string_view holds;    ///< describes the contents
    bool draws = false;        ///< needs WrittenFrame::rgba
    bool layers = false;       ///< needs WrittenFrame::layers; with neither it needs positions
    bool details = false;      ///< needs velocities and contacts
    bool resumes = false;      ///< its files name their run (kept_frames.h); files of other formats are written again
    bool is_archive = false;   ///< its file is a ZIP archive, which may be packed
    bool follows_cuts = true;  ///< its faces may change; false: a scene with cuts is refused
    bool frame_files;          ///< one complete file per frame; otherwise files appear when the run is complete
    /// Returns the least number of bytes for each frame; null: it is not known in advance.
    std::uint64_t (*frame_bytes)(const FrameSize& frame) = nullptr;
    /// Returns whether the format may give a file this name.
    bool (*owns)(std::string_view file_name);
    /// Opens a writer, which the folder must outlive.
    std::unique_ptr<FrameWriter> (*open)(OutputFolder& folder, const WrittenRun& run);
    /// Opens a writer to a stream (`-o -`), without a folder; null: the format cannot be a stream.
    std::unique_ptr<FrameWriter> (*stream)(const ByteSink& sink, const WrittenRun& run) = nullptr;
};

template <class Writer>
std::unique_ptr<FrameWriter> open_writer(OutputFolder& folder, const WrittenRun& run) {
    return std::make_unique<Writer>(folder, run);
}

std::span<const OutputFormat* const> output_formats();
const OutputFormat* find_output_format(std::string_view name);
/// Returns whether --export takes the format: every format but pictures; with `drawn`, also formats made of pictures.
bool exported(const OutputFormat& format, bool drawn);
/// Returns "npy, npz, ...": the formats that --export takes.
std::string export_format_names(bool drawn);
/// Returns "y4m, rgb": the formats that can be a stream.
std::string stream_format_names();

/// Returns the digits of the frame numbers in file names: enough for the last frame, at least four.
int frame_digits(std::uint64_t last_frame);

/// Returns "positions.npy", or "positions_flag.npy" for one of several cloths.
std::string cloth_file_name(std::string_view stem, const WrittenCloth& cloth, std::string_view extension);
bool is_cloth_file_name(std::string_view name, std::string_view stem, std::string_view extension);

/// Returns "mesh_0031.obj", or "mesh_flag_0031.obj" for one of several cloths.
std::string cloth_frame_file_name(std::string_view stem, const WrittenCloth& cloth, std::uint64_t frame, int digits,
                                  std::string_view extension);
bool is_cloth_frame_file_name(std::string_view name, std::string_view stem, std::string_view extension);

}  // namespace drape
