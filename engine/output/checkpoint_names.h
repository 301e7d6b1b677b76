#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

namespace drape {

// The name of the file that a failed run leaves for replay.
inline constexpr std::string_view reproducer_file_name = "failure.reproducer";

// The name of the file that stores what the writers of an unfinished run received (journal.h).
inline constexpr std::string_view journal_file_name = "journal.drape";

// Returns "checkpoint_0000000120.drape" for the state before frame 120; sorted by name they are sorted by frame.
inline std::string checkpoint_file_name(std::uint32_t next_frame) {
    return fmt::format("checkpoint_{:010}.drape", next_frame);
}

inline bool is_checkpoint_file_name(std::string_view name) {
    constexpr std::string_view begin = "checkpoint_", end = ".drape";
    return name.size() == begin.size() + 10 + end.size() && name.starts_with(begin) && name.ends_with(end) &&
           std::ranges::all_of(name.substr(begin.size(), 10), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace drape
