#include <malloc.h>

#include "ending.h"
#include "program.h"
#include "streams.h"

namespace {

/// A driver that runs on the CPU takes some kilobytes for every triangle of a picture and gives them back with it,
/// pages that the system clears again and again unless the program keeps them (docs/devices.md).
void keep_freed_memory() {
    constexpr int mebibyte = 1 << 20;
    mallopt(M_TOP_PAD, 64 * mebibyte);
    mallopt(M_TRIM_THRESHOLD, 512 * mebibyte);
    mallopt(M_MMAP_THRESHOLD, 32 * mebibyte);  // glibc's most; else every larger piece is a mapping of its own
}

}  // namespace

int main(int argc, char** argv) {
    using namespace drape::cli;
    keep_freed_memory();
    prepare_streams();
    try {
        Program program({argv, argv + argc});
        add_commands(program);
        return static_cast<int>(program.run());
    } catch (...) {
        return static_cast<int>(report_current_exception());
    }
}
