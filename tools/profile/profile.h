// Where a frame's time goes: the device's, by stage or pass, and the host's, frame by frame.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "drape/simulation.h"
#include "run/run.h"

namespace drape::profile {

struct ProfileRequest {
    SceneRequest scene;
    bool draw = true;
    bool passes = false;             ///< by pass instead of by stage
    std::uint32_t frame_count = 60;  ///< measured
    std::uint32_t warm_up = 5;       ///< frames before them: shaders are compiled at their first dispatch
    std::function<bool()> stop;      ///< asked before each frame
};

struct ProfiledFrame {
    std::uint32_t frame = 0;
    double begin = 0, end = 0;  ///< s on the host's clock since the first measured frame began
    FrameEffort effort;
    std::vector<StageTime> device;  ///< in order, one per name
};

struct Profile {
    // All of them text: what two profiles must share to be compared.
    std::string program_version, scene, device, driver, solver, kernels, created;
    bool draw = true, passes = false;
    bool substeps_vary = false;  ///< the work is of the substeps that the scene begins with
    std::vector<ProfiledFrame> frames;
    std::vector<PassWork> work;
    std::vector<ResourceMemory> memory;
    std::uint64_t memory_used = 0;  ///< bytes
    double copy_bandwidth = 0;      ///< bytes/s; 0: unavailable
    std::string failure;            ///< why the first frame that is no result is none; its time is a time all the same
    bool stopped = false;
};

/// Throws what Simulation throws.
Profile run_profile(const ProfileRequest& request);

/// Milliseconds in every measured frame.
struct Row {
    /// "frame": from one frame's end to the next, on the host; "device"; then stages or passes. Method `auto` hands out
    /// the frames of a probe together, so there is no "frame" then.
    std::string name;
    std::vector<double> milliseconds;
};
/// Without device times at most "frame".
std::vector<Row> rows_of(const Profile& profile);
/// ms per frame on the host, over all that were measured.
double mean_frame(const Profile& profile);

struct Statistics {
    double minimum = 0, median = 0, p95 = 0, p99 = 0;
    double spread = 0;  ///< interquartile range over the median
};
/// By linear interpolation between the sorted values. There must be one.
Statistics statistics_of(std::vector<double> values);

}  // namespace drape::profile
