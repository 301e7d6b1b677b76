// The PNG library's context, for reading and for writing.
#pragma once

#include <fmt/format.h>
#include <spng.h>

#include <cstdint>
#include <memory>
#include <new>

#include "base/output_error.h"

namespace drape::png {

inline constexpr std::uint32_t side_limit = 16384;
inline constexpr const char* text_keyword = "drape";

using Context = std::unique_ptr<spng_ctx, void (*)(spng_ctx*)>;

inline Context new_context(int flags) {
    Context context(spng_ctx_new(flags), spng_ctx_free);
    if (!context) throw std::bad_alloc();
    return context;
}

inline void check(int result, const char* action) {
    if (result == SPNG_EMEM) throw std::bad_alloc();
    if (result != 0) throw OutputError(fmt::format("PNG: cannot {}: {}", action, spng_strerror(result)));
}

}  // namespace drape::png
