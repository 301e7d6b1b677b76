// A checkpoint's file, raw and with its checksum repaired, and the content of a journal's record give an error, or are
// written as they were read; a controller that was read from one goes on with substeps that exist.
#include <algorithm>
#include <cmath>

#include "base/byte_stream.h"
#include "base/output_error.h"
#include "control/substep_control.h"
#include "run/checkpoints.h"
#include "section_input.h"

namespace drape {
namespace {

using fuzz::require;

constexpr const char* loop_part = "loop";

/// Takes the state of a loop for that of its substep control alone, whose numbers are then any, and goes on with it for
/// a while.
void go_on(const std::vector<std::byte>& bytes) {
    const Method& method = row_of(SolverMethod::line);
    SubstepControl control(method, 8, {2, 4}, 6);
    ByteReader reader(bytes);
    try {
        if (!control.transfer(reader)) return;
    } catch (const Error&) {
        return;
    }
    fuzz::Dice dice({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    const auto rungs = substep_rungs(method);
    for (int frame = 0; frame < 4; ++frame) {
        const bool eventful = dice.chance(0.3);
        control.begin(1 + dice.below(8), eventful);
        auto verdict = SubstepControl::Verdict::again;
        for (int attempt = 0; verdict == SubstepControl::Verdict::again; ++attempt) {
            require(attempt < 100, "a controller that never decides");
            require(std::ranges::count(rungs, control.segment().substeps) == 1, "substeps that no rung has");
            const double stretch = dice.log_uniform(1e-3, 1e3), motion = dice.log_uniform(1e-3, 1e3),
                         coarse = dice.log_uniform(1e-3, 1e3);
            const bool plausible = dice.chance(0.8);
            verdict =
                control.judge({.stretch = stretch, .motion = motion, .coarse_stretch = coarse, .plausible = plausible});
        }
        if (verdict == SubstepControl::Verdict::give_up) control.keep_anyway();
    }
}

/// Throws Error and OutputError.
void read_state(std::span<const std::byte> file) {
    std::string key, again_key;
    const RunCheckpoint checkpoint = checkpoint_of(decode_sections(checkpoint_format, file), key);
    const std::vector<std::byte> written = encode_sections(checkpoint_format, sections_of(checkpoint, key));
    const RunCheckpoint again = checkpoint_of(decode_sections(checkpoint_format, written), again_key);
    require(again_key == key && again.state == checkpoint.state, "a checkpoint is not read as it was written");
    require(encode_sections(checkpoint_format, sections_of(again, again_key)) == written,
            "a checkpoint is not written as it was read");
    if (const auto loop = checkpoint.state.find(loop_part); loop != checkpoint.state.end()) go_on(loop->second);
}

void read_record(std::span<const std::byte> bytes) {
    const std::vector<std::byte> written = encode_record(decode_record(bytes));
    require(encode_record(decode_record(written)) == written, "a record is not written as it was read");
}

template <class Read>
void try_to(const Read& read) {
    try {
        read();
    } catch (const Error&) {
    } catch (const OutputError&) {
    }
}

}  // namespace
}  // namespace drape

extern "C" int DRAPE_FUZZ_ENTRY(checkpoint)(const std::uint8_t* data, std::size_t size) {
    using namespace drape;
    std::vector<std::byte> file = fuzz::bytes_of(data, size);
    try_to([&] { read_record(file); });
    try_to([&] { go_on(file); });
    try_to([&] { read_state(file); });
    fuzz::repair(checkpoint_format, file);
    try_to([&] { read_state(file); });
    return 0;
}
