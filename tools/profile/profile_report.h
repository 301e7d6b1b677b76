// A profile as a table, CSV, JSON shaped like Google Benchmark's, and a Chrome trace.
#pragma once

#include <string>

#include "profile/profile.h"

namespace drape::profile {

std::string profile_text(const Profile& profile);
/// A row per name: name, minimum, median, p95, p99 (ms), spread, and of passes count, bytes, bytes/s, share of a copy,
/// floating-point operations (step_flops.h), operations/s.
std::string profile_csv(const Profile& profile);
/// "context", and in "benchmarks" a repetition per measured frame and the aggregates of each name.
std::string profile_json(const Profile& profile);
/// Trace events: a track of the host's frames and one of the device's work, whose durations are measured and whose
/// places are not: they are laid end to end so that the last ends with its frame.
std::string profile_trace(const Profile& profile);

}  // namespace drape::profile
