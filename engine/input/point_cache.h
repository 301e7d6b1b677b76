// The header of a point cache (PC2).
#pragma once

#include <cstdint>

#include "input/file_source.h"

namespace drape::input {

struct PointCacheHead {
    char signature[12];
    std::int32_t version, points;
    float start, step;
    std::int32_t samples;
};
static_assert(sizeof(PointCacheHead) == 32);

/// Throws OutputError for a file that does not begin with one, or has no sample.
PointCacheHead read_head(FileSource& file);

}  // namespace drape::input
