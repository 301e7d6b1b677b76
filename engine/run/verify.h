// Runs scenes and judges them by what their files promise and by what every run must keep.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "drape/scene_reader.h"

namespace drape::verify {

struct Request {
    std::vector<std::string> overrides;  ///< "/json/pointer=value"
    std::string device;                  ///< a selector of Device; may be empty
    bool validate = true;                ///< core and synchronization validation; each message is a failure
    /// Optional limits for every frame and cloth: the RMS strain of the stretch springs; their RMS stretch error; the
    /// depth, m, below the surface that contact keeps free.
    std::optional<double> stretch, stretch_error, penetration;
    std::function<bool()> stop;  ///< asked before each frame
};

struct Finding {
    std::string check;
    bool met = false;
    std::string text;  ///< what was measured, and against which limit
};

struct Report {
    std::string file;
    std::vector<SceneError> errors;  ///< errors of the scene, which was then not simulated
    bool unreadable = false;         ///< the errors are about reading the file
    std::uint32_t frame_count = 0;   ///< number of frames that were simulated
    double seconds = 0;              ///< wall-clock time
    std::vector<Finding> findings;
    bool stopped = false;  ///< Request::stop ended the run, so it is not judged

    bool met() const;
};

/// Simulates the scene of a file to its end and judges it. The report contains the errors of the scene. Throws
/// DeviceError.
Report verify_scene(const std::string& path, const Request& request);

/// Returns the lines about a scene, for human readers.
std::string report_text(const Report& report);
std::string reports_json(const std::vector<Report>& reports);
/// Returns JUnit XML, with a test suite for each scene and a test case for each check.
std::string reports_junit(const std::vector<Report>& reports);

}  // namespace drape::verify
