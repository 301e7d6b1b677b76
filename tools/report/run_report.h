// A run, or two side by side, as one HTML page that needs nothing else: no network, no other file.
#pragma once

#include <string>
#include <vector>

#include "report/run_folder.h"

namespace drape::report {

struct ReportOptions {
    std::uint32_t frames = 60;  ///< at most so many pictures, evenly spread
    std::uint32_t width = 480;  ///< of a picture, pixels
    double megabytes = 8;       ///< of positions of a run, at most; 0: none
};

/// Well-formed as XML too. Throws OutputError when a picture cannot be read.
std::string report_html(const std::vector<RunFolder>& runs, const ReportOptions& options);

}  // namespace drape::report
