#include "input/available_memory.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include "base/output_error.h"

namespace drape {

std::uint64_t available_memory() {
    std::uint64_t available = std::numeric_limits<std::uint64_t>::max();
    std::ifstream system("/proc/meminfo");
    for (std::string name, unit; system >> name;) {
        std::uint64_t kibibytes = 0;
        if (name == "MemAvailable:" && system >> kibibytes) available = kibibytes * 1024;
        std::getline(system, unit);
    }
    rlimit space{};
    std::uint64_t pages = 0;
    if (getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY &&
        std::ifstream("/proc/self/statm") >> pages) {
        const std::uint64_t used = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
        available = std::min<std::uint64_t>(available, space.rlim_cur > used ? space.rlim_cur - used : 0);
    }
    return available;
}

void expect_memory(const std::string& what, std::uint64_t bytes) {
    const std::uint64_t available = available_memory();
    if (bytes > available)
        throw OutputError(fmt::format("{} needs {} MB, and {} MB of memory are available", what, bytes / 1'000'000,
                                      available / 1'000'000));
}

}  // namespace drape
