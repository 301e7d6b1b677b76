#pragma once

#include <cstdint>

namespace drape {

inline constexpr std::uint32_t scene_frame_limit = 1'000'000;

}  // namespace drape
