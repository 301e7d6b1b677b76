// The command line documents these exit codes; there is no other list of them.
#pragma once

#include <array>
#include <string>

namespace drape {

enum class ExitCode : int {
    ok = 0,
    io = 1,
    usage = 2,
    scene = 3,
    device = 4,
    diverged = 5,
    validation = 6,
    comparison = 7,
    tolerance = 8,
    sweep = 9,
    internal = 70,
    interrupted = 130,
    terminated = 143,
};

struct ExitCodeRow {
    ExitCode code;
    const char* name;
    const char* meaning;
};

inline constexpr std::array<ExitCodeRow, 13> exit_code_rows{{
    {ExitCode::ok, "ok", "everything that was asked for is done"},
    {ExitCode::io, "file", "a file, a folder or stdout could not be read or written"},
    {ExitCode::usage, "usage", "the command line is wrong"},
    {ExitCode::scene, "scene", "a scene is wrong"},
    {ExitCode::device, "device", "no usable device, a failing Vulkan call, no memory left"},
    {ExitCode::diverged, "diverged", "the simulation is no longer finite, or not plausible"},
    {ExitCode::validation, "validation", "a validation message was reported"},
    {ExitCode::comparison, "comparison", "a number is over its limit, or there is none to compare"},
    {ExitCode::tolerance, "tolerance", "a frame misses the tolerance, or what method auto keeps"},
    {ExitCode::sweep, "sweep", "some runs of a sweep failed or are missing"},
    {ExitCode::internal, "internal error", "a defect of the program; please report the message"},
    {ExitCode::interrupted, "interrupted", "stopped by SIGINT"},
    {ExitCode::terminated, "terminated", "stopped by SIGTERM"},
}};

/// Returns "0 ok, 1 file, ...", in lines of at most `columns`.
std::string exit_code_list(std::size_t columns = 110);

/// Returns a line per code: number, name, meaning.
std::string exit_code_table();

}  // namespace drape
