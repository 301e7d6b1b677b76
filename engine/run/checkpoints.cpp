#include "run/checkpoints.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "base/byte_stream.h"
#include "output/atomic_file.h"
#include "output/checkpoint_names.h"

namespace drape {

namespace {

constexpr const char *run_part = "run", *state_prefix = "state/";

template <class Archive, class Failure>
void transfer_failure(Archive& archive, Failure& failure, std::uint32_t& kind) {
    archive(kind, failure.reason, failure.frame, failure.criterion, failure.value, failure.bound, failure.cloth);
}

void put_failure(ByteWriter& writer, const std::optional<FrameFailure>& failure) {
    writer(failure.has_value());
    if (!failure) return;
    auto kind = static_cast<std::uint32_t>(failure->kind);
    transfer_failure(writer, *failure, kind);
    writer(failure->particle.has_value());
    if (failure->particle) writer((*failure->particle)[0], (*failure->particle)[1]);
}

std::optional<FrameFailure> get_failure(ByteReader& reader) {
    bool is_there = false;
    reader(is_there);
    if (!is_there) return std::nullopt;
    FrameFailure failure{};
    std::uint32_t kind = 0;
    transfer_failure(reader, failure, kind);
    if (kind > static_cast<std::uint32_t>(FrameFailure::Kind::tolerance)) throw Error("a failure of no kind");
    failure.kind = static_cast<FrameFailure::Kind>(kind);
    reader(is_there);
    if (is_there) {
        auto& particle = failure.particle.emplace();
        reader(particle[0], particle[1]);
    }
    return failure;
}

/// Returns the names of the checkpoints, newest first.
std::vector<std::string> names_in(const OutputFolder& folder) {
    std::vector<std::string> names = folder.file_names();
    std::erase_if(names, [](const std::string& name) { return !is_checkpoint_file_name(name); });
    std::ranges::sort(names, std::ranges::greater());
    return names;
}

void remove(const OutputFolder& folder, const std::string& name) {
    if (unlinkat(folder.descriptor(), name.c_str(), 0) != 0 && errno != ENOENT)
        throw system_error_at("remove", folder.path_of(name), errno);
}

}  // namespace

Sections sections_of(const RunCheckpoint& checkpoint, const std::string& run_key) {
    Sections sections;
    for (const auto& [name, bytes] : checkpoint.state) sections[state_prefix + name] = bytes;
    ByteWriter writer;
    writer(run_key, checkpoint.next_frame, checkpoint.journal_length, checkpoint.validation_count);
    put_failure(writer, checkpoint.failure);
    sections[run_part] = writer.take();
    return sections;
}

RunCheckpoint checkpoint_of(const Sections& sections, std::string& run_key) {
    const auto run = sections.find(run_part);
    if (run == sections.end()) throw Error("it has no part 'run'");
    RunCheckpoint checkpoint;
    ByteReader reader(run->second);
    reader(run_key, checkpoint.next_frame, checkpoint.journal_length, checkpoint.validation_count);
    checkpoint.failure = get_failure(reader);
    const std::string prefix = state_prefix;
    for (const auto& [name, bytes] : sections)
        if (name.starts_with(prefix)) checkpoint.state[name.substr(prefix.size())] = bytes;
    return checkpoint;
}

Checkpoints::Checkpoints(OutputFolder& folder, std::string run_key, std::optional<double> interval)
    : folder_(folder), run_key_(std::move(run_key)), interval_(interval), journal_(folder, run_key_) {}

std::optional<RunCheckpoint> Checkpoints::newest(const std::function<bool(const RunCheckpoint&)>& usable,
                                                 const std::function<void(const std::string&)>& say) const {
    std::string damage;
    bool found = false;
    for (const std::string& name : names_in(folder_)) {
        const std::string path = folder_.path_of(name);
        std::optional<RunCheckpoint> checkpoint;
        std::string key;
        try {
            const std::vector<std::uint8_t> bytes = folder_.read_file(name);
            checkpoint = checkpoint_of(decode_sections(checkpoint_format, std::as_bytes(std::span(bytes))), key);
        } catch (const std::exception& error) {
            damage = fmt::format("'{}' {}", path, error.what());
            say(fmt::format("warning: {}: an older checkpoint is looked for", damage));
            continue;
        }
        if (key != run_key_)
            throw OutputError(
                fmt::format("cannot resume: '{}' was left by another run (other scene, size, samples, view, "
                            "program version, device or driver): use --overwrite to replace an earlier "
                            "run's files, or choose another folder",
                            path));
        try {
            found = true;
            if (usable(*checkpoint)) return checkpoint;
        } catch (const OutputError& error) {  // the journal is damaged
            found = false;
            damage = error.what();
            say(fmt::format("warning: {}: an older checkpoint is looked for", damage));
        }
    }
    if (!found && !damage.empty())
        throw OutputError(
            fmt::format("cannot resume: {}: remove the checkpoint_*.drape files to begin again at frame "
                        "0, or use --overwrite",
                        damage));
    if (found) say("note: files from before the checkpoints are missing: everything is simulated again, from frame 0");
    return std::nullopt;
}

bool Checkpoints::due() const {
    return interval_ && std::chrono::duration<double>(std::chrono::steady_clock::now() - last_).count() >= *interval_;
}

void Checkpoints::write(RunCheckpoint checkpoint) {
    checkpoint.journal_length = journal_.sync();
    folder_.sync();  // the directory's entries of the earlier frames reach the disk
    const std::string name = checkpoint_file_name(checkpoint.next_frame);
    write_file(folder_, name, encode_sections(checkpoint_format, sections_of(checkpoint, run_key_)));
    folder_.sync();
    std::vector<std::string> names = names_in(folder_);
    // Newer checkpoints belong to a run that has since gone back, or are damaged.
    std::erase_if(names, [&](const std::string& other) { return other == name; });
    const auto older = std::ranges::find_if(names, [&](const std::string& other) { return other < name; });
    for (const std::string& other : names)
        if (older == names.end() || other != *older) remove(folder_, other);
    last_ = std::chrono::steady_clock::now();
}

std::optional<RunCheckpoint> Checkpoints::last() const {
    for (const std::string& name : names_in(folder_)) {
        try {
            std::string key;
            const std::vector<std::uint8_t> bytes = folder_.read_file(name);
            return checkpoint_of(decode_sections(checkpoint_format, std::as_bytes(std::span(bytes))), key);
        } catch (const std::runtime_error&) {  // an older checkpoint may be readable
        }
    }
    return std::nullopt;
}

void Checkpoints::keep_until(std::uint32_t next_frame) {
    for (const std::string& name : names_in(folder_))
        if (next_frame == 0 || name > checkpoint_file_name(next_frame)) remove(folder_, name);
}

void Checkpoints::remove_all() {
    for (const std::string& name : names_in(folder_)) remove(folder_, name);
    if (folder_.has_file(std::string(journal_file_name))) remove(folder_, std::string(journal_file_name));
}

}  // namespace drape
