#include "cloth/rungs.h"

#include <algorithm>

namespace drape {

namespace {

constexpr std::uint32_t rungs[] = {2,   4,   6,   8,   12,  16,  24,   32,   48,   64,   96,
                                   128, 192, 256, 384, 512, 768, 1024, 1536, 2048, 3072, 4096};

}  // namespace

std::span<const std::uint32_t> substep_rungs(const Method& method) {
    const auto* end = std::ranges::upper_bound(rungs, method.most_substeps);
    return {std::begin(rungs), end};
}

std::uint32_t first_rung(const Method& method, double substeps) {
    const auto all = substep_rungs(method);
    const auto place = std::ranges::find_if(all, [&](std::uint32_t rung) { return rung >= substeps; });
    return place == all.end() ? all.back() : *place;
}

}  // namespace drape
