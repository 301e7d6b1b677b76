#pragma once

#include <json/value.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drape/error.h"
#include "drape/look.h"
#include "drape/momenta.h"
#include "output/atomic_file.h"
#include "output/kept_frames.h"
#include "output/output_folder.h"

namespace drape {

// Says what a run was and what it made. It is written last: a folder with a manifest is finished. Two runs of the same
// program on the same scene and device give the same JSON except for the key "run" (time, command line, speed), which
// comparisons ignore.
struct Manifest {
    struct Scene {
        std::string path;
        std::string name;
        std::string hash;                    // xxh3_128_hex of the scene's text after the overrides
        std::vector<std::string> overrides;  // "/json/pointer=value"
    };
    struct Device {
        std::string name;
        std::string driver;
        std::string driver_version;
        std::string api_version;
        std::string uuid;
    };
    struct Frames {
        std::int64_t start = 0;
        std::int64_t end = 0;  // inclusive
        std::int64_t step = 1;
        std::uint64_t count = 0;
        double fps = 0;
    };
    struct Picture {
        std::uint32_t width = 0;
        std::uint32_t height = 0;
        std::uint32_t samples = 0;      // per pixel
        std::string view;               // name of the view, unless it shows what a camera would
        double strain_range = 0;        // strain at the end of a heat map; 0: no heat map
        std::optional<Camera> camera;   // one that stands still
        std::uint32_t motion_blur = 1;  // moments that a picture is the mean of
    };
    struct Solver {
        std::string method;   // in use
        std::string kernels;  // in use
        std::uint32_t substeps = 0;
        std::uint32_t iterations = 0;
        bool tethers = false;
        std::string asked;                    // the scene's method, when that was to choose
        std::string choice;                   // the reason for that method
        double tolerance = 0;                 // bound of the RMS stretch error; 0: none
        std::optional<double> stretch_error;  // worst RMS of any cloth and frame, written or not
    };
    struct Validation {
        bool enabled = false;
        std::uint64_t message_count = 0;
    };
    struct Skipped {
        std::string what;  // a pass, a pipeline, an image, ...
        std::string reason;
    };
    struct Compromise {
        std::string what;  // "<cloth>/stiffness"
        std::string reason;
        std::uint32_t enough_substeps = 0;  // enough to follow all of it; 0: none would
    };
    struct SplitTriangles {  // triangles of a cloth, split by cutters, that contact leaves out
        std::string cloth;
        std::int64_t first_frame = 0;  // the first frame in which some are split
        std::uint64_t count = 0;       // in the last frame
    };
    struct SeamTriangles {  // triangles of a cloth beside seams, that contact leaves out
        std::string cloth;
        std::uint64_t count = 0;          // for good: a corner lies between two others
        std::uint64_t closing_count = 0;  // which meet others only once their seams have closed
    };
    struct SelfCollision {
        std::vector<std::string> cloths;              // names of cloths that meet themselves
        bool between_cloths = false;                  // all cloths meet each other
        std::optional<std::uint32_t> first_unproved;  // frame; nothing: no crossing in any substep
        std::vector<SplitTriangles> not_covered;      // triangles without proof; the earliest first
        std::vector<SeamTriangles> beside_seams;      // further triangles without proof
        double seams_close = 0;                       // s: when the last of those seams has
        std::uint32_t most_pairs = 0;                 // pairs that were near each other in a substep
        std::uint64_t truncated = 0;                  // motions cut short
        double longest_lag = 0;                       // m, the farthest that one was held back in a substep
        double lag_limit = 0;                         // m, the largest acceptable lag
        std::uint32_t lagging_frames = 0;             // number of frames with a longer lag
        std::vector<std::pair<std::string, std::string>> crossed;  // cloths that started through each other
        std::optional<std::uint32_t> apart_since;                  // frame from which on none of them crosses another
    };
    struct Cut {  // found at the end of the frame; takes effect in the next one
        std::int64_t frame = 0;
        std::string cloth;
        std::uint32_t spring_count = 0;    // cut
        std::uint32_t torn_count = 0;      // of those, torn
        std::uint32_t triangle_count = 0;  // split
        std::uint32_t piece_count = 0;     // pieces that there are now
        std::uint32_t crumb_count = 0;     // crumbs that there are now
    };
    struct FrameTime {  // wall-clock milliseconds per frame
        double median = 0;
        double minimum = 0;
        double maximum = 0;
    };
    struct FrameStatistics {
        std::int64_t frame = 0;
        FrameValues values;  // names carry the unit where there is one: "kinetic_energy_j"
    };
    using FrameVisitor = std::function<void(const FrameStatistics&)>;

    std::string program_version, program_commit;
    // "diverged", "tolerance missed": the run ended before its end, with what came before, or went on as it was asked
    // to; "device failed", "output failed", "out of memory", "internal error": it broke off; "validation messages"
    std::string status = "done";
    std::string failure;                       // the reason, if the run is not done
    std::string reproducer;                    // file that replays the failure; empty: there is none
    std::optional<FrameFailure> failed_frame;  // the frame that was no result
    std::string run_key;                       // the run's key (kept_frames.h)
    Scene scene;
    Device device;
    Frames frames;
    std::optional<Picture> picture;  // nothing when neither pictures nor layers were made
    Solver solver;
    Validation validation;
    std::vector<Skipped> skipped;
    std::vector<Compromise> compromises;
    std::vector<Momenta> momenta;       // by cloth: what may change its momenta
    std::vector<std::string> warnings;  // the warnings that were given, compromises included
    std::optional<SelfCollision> self_collision;
    std::vector<SplitTriangles> off_collider_edges;  // edges of boxes are not kept off these; the earliest first
    std::vector<Cut> cuts;
    std::vector<FileRecord> files;
    // Calls the visitor for every frame, in order, since a long run's frames are not all in memory. Null: there are
    // none.
    std::function<void(const FrameVisitor&)> statistics;

    // The contents of the key "run".
    std::string created;  // utc_timestamp()
    std::vector<std::string> command_line;
    std::optional<FrameTime> frame_time;
    std::map<std::string, double> stage_median_ms;  // stage -> median device milliseconds per frame
};

// Returns median, minimum and maximum; nothing for no frames.
std::optional<Manifest::FrameTime> summarize_frame_times(std::span<const double> milliseconds);

// Returns "46 triangles of cloth 'flag'", or of several cloths "58 triangles".
std::string triangles_text(std::span<const Manifest::SplitTriangles> split);

// Returns a time as "2024-05-31T12:00:00Z".
std::string utc_timestamp(std::chrono::system_clock::time_point time = std::chrono::system_clock::now());

// Passes UTF-8 JSON to `append` piece by piece; doubles have the fewest digits that read back as the same double.
// Throws OutputError, which names the number, when one is not finite (JSON has no such numbers, and such a run is not
// done).
void put_manifest(const Manifest& manifest, const std::function<void(std::string_view)>& append);

// The parts of a folder's manifest that are read, with the types for writing. Throws OutputError, which names the file.
Json::Value read_manifest(const std::filesystem::path& folder);

// Writes manifest.json after all files of the run have reached the disk. Throws OutputError.
void write_manifest(OutputFolder& folder, const Manifest& manifest);

}  // namespace drape
