#include "simulation/state_checksum.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cstring>
#include <string_view>

namespace drape {

namespace {

constexpr const char* checksum_part = "checksum";

std::vector<std::byte> checksum_of(const SimulationState& state) {
    XXH3_state_t hash;
    XXH3_128bits_reset(&hash);
    const auto add = [&](const void* bytes, std::uint64_t size) {
        XXH3_128bits_update(&hash, &size, sizeof size);
        if (size > 0) XXH3_128bits_update(&hash, bytes, size);
    };
    const std::uint64_t count = state.size() - state.count(checksum_part);
    XXH3_128bits_update(&hash, &count, sizeof count);
    for (const auto& [name, content] : state) {
        if (name == checksum_part) continue;
        add(name.data(), name.size());
        add(content.data(), content.size());
    }
    const XXH128_hash_t sum = XXH3_128bits_digest(&hash);
    std::vector<std::byte> bytes(sizeof sum.low64 + sizeof sum.high64);
    std::memcpy(bytes.data(), &sum.low64, sizeof sum.low64);
    std::memcpy(bytes.data() + sizeof sum.low64, &sum.high64, sizeof sum.high64);
    return bytes;
}

}  // namespace

void seal(SimulationState& state) { state[checksum_part] = checksum_of(state); }

void expect_sealed(const SimulationState& state) {
    const auto part = state.find(checksum_part);
    if (part == state.end())
        throw Error("the saved state has no checksum: it is damaged, or was saved before states had one");
    if (part->second != checksum_of(state)) throw Error("the saved state is damaged: its checksum does not fit");
}

}  // namespace drape
