// Checks that there is memory for what a file claims to hold.
#pragma once

#include <cstdint>
#include <string>

namespace drape {

// Bytes that this process can still get: what the system can give without swapping, and what a limit on the address
// space (`ulimit -v`) leaves.
std::uint64_t available_memory();

// Throws OutputError, "WHAT needs 3000 MB, and 1200 MB of memory are available", when that is so.
void expect_memory(const std::string& what, std::uint64_t bytes);

}  // namespace drape
