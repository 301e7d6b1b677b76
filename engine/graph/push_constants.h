// The push constants of a dispatch, for any struct.
#pragma once

#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

#include "shared/struct_layout.h"

namespace drape::graph {

/// The bytes of a struct that C++ shares with GLSL, and its layout, which the shader's block must match.
struct PushConstants {
    /// For a pipeline without push constants.
    PushConstants() = default;
    template <class T>
    requires(!std::same_as<T, PushConstants>) PushConstants(const T& value)
        : layout(&glsl::layout_of<T>()) {  // NOLINT(google-explicit-constructor)
        const std::span<const std::byte> all = std::as_bytes(std::span<const T>(&value, 1));
        bytes.assign(all.begin(), all.end());
    }

    const glsl::StructLayout* layout = nullptr;
    std::vector<std::byte> bytes;
};

}  // namespace drape::graph
