// Runs scenes and judges them: what their files promise, and what every run must keep.
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
    bool validate = true;                ///< core and synchronization validation, each message a failure
    /// Limits of every frame and cloth, where they are wanted: RMS strain of the stretch springs; their RMS stretch
    /// error; m below the surface that contact keeps free.
    std::optional<double> stretch, stretch_error, penetration;
    std::function<bool()> stop;  ///< asked before each frame
};

struct Finding {
    std::string check;
    bool met = false;
    std::string text;  ///< says what was measured, against which limit
};

struct Report {
    std::string file;
    std::vector<SceneError> errors;  ///< errors of the scene, which was then not run
    bool unreadable = false;         ///< the errors are of reading the file
    std::uint32_t frame_count = 0;   ///< number of frames that were run
    double seconds = 0;              ///< wall-clock time
    std::vector<Finding> findings;
    bool stopped = false;  ///< Request::stop ended the run, which is not judged

    bool met() const;
};

/// Runs the scene of a file to its end and judges it. What is wrong with the scene is in the report; throws
/// DeviceError.
Report verify_scene(const std::string& path, const Request& request);

/// Returns a scene's lines, for people.
std::string report_text(const Report& report);
std::string reports_json(const std::vector<Report>& reports);
/// Returns JUnit's XML: a test suite per scene, a test case per check.
std::string reports_junit(const std::vector<Report>& reports);

}  // namespace drape::verify
