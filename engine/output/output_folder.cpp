#include "output/output_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/vfs.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <fstream>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <system_error>
#include <utility>

#include "output/checkpoint_names.h"
#include "output/frame_writer.h"
#include "output/json_file.h"

namespace drape {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view temporary_mark = ".tmp-";

bool all_digits(std::string_view text) {
    return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

// The digits after the mark of a temporary name.
std::optional<std::string_view> process_in(std::string_view name) {
    const size_t mark = name.rfind(temporary_mark);
    if (mark == std::string_view::npos) return std::nullopt;
    const std::string_view digits = name.substr(mark + temporary_mark.size());
    return all_digits(digits) ? std::optional(digits) : std::nullopt;
}

bool is_finished_file_name(std::string_view name) {
    return name == manifest_file_name || name == reproducer_file_name || name == journal_file_name ||
           is_checkpoint_file_name(name) ||
           std::ranges::any_of(output_formats(), [&](const OutputFormat* format) { return format->owns(name); });
}

// A frame's file, of whatever run, would look like one of another run beside this run's files.
bool is_loose_frame_file_name(std::string_view name) {
    return std::ranges::any_of(output_formats(), [&](const OutputFormat* format) {
        return format->frame_files && !format->resumes && format->owns(name);
    });
}

// Returns the file names that a manifest lists, whatever they are (only names found in the folder are ever removed);
// nothing when the file is not a manifest of this program.
std::optional<std::set<std::string>> names_in_manifest(const fs::path& manifest_path) {
    std::ifstream file(manifest_path, std::ios::binary);
    std::ostringstream text;
    if (!file || !(text << file.rdbuf())) return std::nullopt;
    const std::optional<Json::Value> root = parse_json(std::move(text).str());
    if (!root || !root->isObject() || (*root)["format"] != Json::Value(std::string(manifest_format)))
        return std::nullopt;
    std::set<std::string> names;
    const Json::Value& files = (*root)["files"];
    if (!files.isArray()) return std::nullopt;
    for (const Json::Value& entry : files)
        if (entry.isObject() && entry["name"].isString()) names.insert(entry["name"].asString());
    return names;
}

struct Entry {
    std::string name;
    bool is_folder;
};

std::vector<Entry> list_entries(const fs::path& path) {
    std::vector<Entry> entries;
    std::error_code error;
    for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error)) {
        std::error_code status_error;
        const bool is_folder = entry->symlink_status(status_error).type() == fs::file_type::directory;
        entries.push_back({entry->path().filename().string(), is_folder});
    }
    if (error) throw system_error_at("list output folder", path.string(), error.value());
    std::ranges::sort(entries, {}, &Entry::name);
    return entries;
}

void ignore_file_size_signal() {
    struct sigaction action {};
    if (sigaction(SIGXFSZ, nullptr, &action) == 0 && action.sa_handler == SIG_DFL) {
        action.sa_handler = SIG_IGN;
        sigaction(SIGXFSZ, &action, nullptr);
    }
}

}  // namespace

bool is_plain_file_name(std::string_view name) {
    return !name.empty() && name != "." && name != ".." && name.find('/') == std::string_view::npos &&
           name.find('\0') == std::string_view::npos;
}

bool is_temporary_file_name(std::string_view name) {
    const auto process = process_in(name);
    return process && is_finished_file_name(name.substr(0, name.size() - process->size() - temporary_mark.size()));
}

bool is_left_over(std::string_view name) {
    const auto process = process_in(name);
    pid_t number = 0;
    if (!process || std::from_chars(process->data(), process->data() + process->size(), number).ec != std::errc{})
        return false;
    return kill(number, 0) != 0 && errno == ESRCH;
}

bool is_output_file_name(std::string_view name) { return is_finished_file_name(name) || is_temporary_file_name(name); }

OutputFolder::OutputFolder(const fs::path& path, ExistingFiles existing) : path_(path) {
    if (path.empty()) throw OutputError("the name of the output folder is empty");
    ignore_file_size_signal();
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) {
        const int error = errno;
        if (error != ENOENT) throw system_error_at("use output folder", path.string(), error);
        if (lstat(path.c_str(), &status) == 0) {
            throw OutputError(fmt::format("output folder '{}' is a symbolic link to '{}', which does not exist",
                                          path.string(), fs::read_symlink(path).string()));
        }
    } else if (!S_ISDIR(status.st_mode)) {
        throw OutputError(fmt::format("output folder '{}' is a file, not a folder", path.string()));
    }
    try {
        create_missing_folders();
        open_and_lock();
        check_content(existing);
        check_writable();
    } catch (...) {
        remove_created_folders();
        throw;
    }
}

OutputFolder::~OutputFolder() { remove_created_folders(); }

void OutputFolder::create_missing_folders() {
    const fs::path absolute = fs::absolute(path_);
    fs::path prefix;
    for (const fs::path& component : absolute) {
        prefix /= component;
        if (component.empty() || component == "/") continue;
        if (mkdir(prefix.c_str(), 0777) == 0) {
            created_folders_.push_back(prefix);
        } else if (const int error = errno; error != EEXIST) {
            // A parent that exists may sit on a read-only file system, where mkdir says so before it says EEXIST.
            std::error_code status_error;
            if (fs::is_directory(prefix, status_error)) continue;
            throw system_error_at("create output folder", prefix.string(), error);
        }
    }
}

// Only empty folders go: rmdir refuses the others, which then are the result of the run.
void OutputFolder::remove_created_folders() noexcept {
    for (auto folder = created_folders_.rbegin(); folder != created_folders_.rend(); ++folder) {
        if (rmdir(folder->c_str()) != 0) break;
    }
    created_folders_.clear();
}

void OutputFolder::open_and_lock() {
    descriptor_ = FileDescriptor(open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!descriptor_) throw system_error_at("open output folder", path_.string(), errno);
    is_locked_ = flock(descriptor_.get(), LOCK_EX | LOCK_NB) == 0;
    if (!is_locked_ && errno == EWOULDBLOCK) {
        throw OutputError(fmt::format("another drape is writing to output folder '{}'", path_.string()));
    }
}

void OutputFolder::check_content(ExistingFiles existing) {
    std::vector<Entry> entries = list_entries(path_);
    // The process that holds the lock knows that no other one is writing.
    std::erase_if(entries, [&](const Entry& entry) {
        const bool goes = !entry.is_folder && is_temporary_file_name(entry.name) &&
                          (is_locked_ || existing != ExistingFiles::refuse || is_left_over(entry.name));
        if (goes) files_to_remove_.push_back(entry.name);
        return goes;
    });
    if (entries.empty()) return;
    if (existing == ExistingFiles::refuse) {
        throw OutputError(
            fmt::format("output folder '{}' is not empty (it holds {}{}): use --overwrite to replace an "
                        "earlier run's files, "
                        "--resume to continue that run, or choose another folder",
                        path_.string(), entries.front().name,
                        entries.size() > 1 ? fmt::format(" and {} more", entries.size() - 1) : ""));
    }
    std::set<std::string> listed;
    if (has_file(std::string(manifest_file_name))) {
        // Many kinds of programs keep a manifest.json, which ours would replace.
        const auto names = names_in_manifest(path_ / manifest_file_name);
        if (!names) {
            throw OutputError(fmt::format("'{}' was not written by drape: choose another output folder",
                                          path_of(manifest_file_name)));
        }
        listed = *names;
    }
    for (const Entry& entry : entries) {
        if (entry.is_folder) continue;
        const bool goes = existing == ExistingFiles::resume
                              ? is_loose_frame_file_name(entry.name) || entry.name == manifest_file_name ||
                                    entry.name == reproducer_file_name
                              : is_output_file_name(entry.name) || listed.contains(entry.name);
        if (goes) files_to_remove_.push_back(entry.name);
    }
    std::ranges::sort(files_to_remove_);
}

void OutputFolder::check_writable() const {
    // An unnamed file is the only probe that leaves nothing behind, even when the program is killed in between.
    const FileDescriptor probe(openat(descriptor_.get(), ".", O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600));
    if (probe) return;
    int error = errno;
    if (error == EOPNOTSUPP || error == EISDIR || error == ENOENT || error == EINVAL) {
        if (faccessat(descriptor_.get(), ".", W_OK | X_OK, AT_EACCESS) == 0) return;
        error = errno;
    }
    throw system_error_at("write to output folder", path_.string(), error);
}

bool OutputFolder::has_file(const std::string& name) const {
    struct stat status {};
    return fstatat(descriptor_.get(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0;
}

std::vector<std::string> OutputFolder::file_names() const {
    std::vector<std::string> names;
    for (Entry& entry : list_entries(path_))
        if (!entry.is_folder) names.push_back(std::move(entry.name));
    return names;
}

std::vector<std::uint8_t> OutputFolder::read_file(const std::string& name) const {
    // O_NONBLOCK keeps a named pipe from making the program wait for a writer.
    const FileDescriptor file(openat(descriptor_.get(), name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    struct stat status {};
    if (!file || fstat(file.get(), &status) != 0) throw system_error_at("read", path_of(name), errno);
    if (!S_ISREG(status.st_mode)) throw OutputError(fmt::format("cannot read '{}': not a regular file", path_of(name)));
    std::vector<std::uint8_t> bytes(static_cast<size_t>(status.st_size));
    for (size_t done = 0; done < bytes.size();) {
        const ssize_t count = read(file.get(), bytes.data() + done, bytes.size() - done);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throw system_error_at("read", path_of(name), errno);
        if (count == 0) bytes.resize(done);  // the file was shortened meanwhile
        done += static_cast<size_t>(count);
    }
    return bytes;
}

void OutputFolder::expect_room(std::uint64_t bytes) const {
    // By f_type of statfs(2): how much more than the free space may fit at most. BTRFS keeps a page of 32 at least,
    // and may lie below an overlay.
    constexpr std::pair<std::uint32_t, std::uint64_t> known[] = {
        {0xef53, 1}, {0x58465342, 1}, {0x01021994, 1}, {0x9123683e, 32}, {0x794c7630, 32}};  // ext, xfs, tmpfs, ...
    struct statfs status {};
    if (fstatfs(descriptor_.get(), &status) != 0 || status.f_blocks == 0) return;
    const auto* system =
        std::ranges::find(known, static_cast<std::uint32_t>(status.f_type), [](const auto& row) { return row.first; });
    if (system == std::end(known)) return;
    std::uint64_t room =
        (geteuid() == 0 ? status.f_bfree : status.f_bavail) * static_cast<std::uint64_t>(status.f_bsize);
    for (const std::string& name : files_to_remove()) {
        struct stat file {};
        if (fstatat(descriptor_.get(), name.c_str(), &file, AT_SYMLINK_NOFOLLOW) == 0)
            room += static_cast<std::uint64_t>(file.st_size);
    }
    if (bytes / system->second > room)
        throw OutputError(
            fmt::format("output folder '{}' has room for {:.1f} GB, and the run would write {:.1f} GB: fewer frames "
                        "(-s, -e, -j) or another format take less",
                        path_.string(), static_cast<double>(room) / 1e9, static_cast<double>(bytes) / 1e9));
}

void OutputFolder::begin_writing() {
    const std::scoped_lock lock(writing_mutex_);
    if (writing_begun_) return;
    // The manifest is removed first: a folder that lost some of its frames must not look finished.
    std::ranges::stable_partition(files_to_remove_, [](const auto& name) { return name == manifest_file_name; });
    for (const std::string& name : files_to_remove_) {
        if (unlinkat(descriptor_.get(), name.c_str(), 0) != 0 && errno != ENOENT) {
            throw system_error_at("remove the earlier run's file", path_of(name), errno);
        }
    }
    writing_begun_ = true;
}

void OutputFolder::sync() const {
    // A file system that cannot sync folders gives EINVAL.
    if (fsync(descriptor_.get()) != 0 && errno != EINVAL) {
        throw system_error_at("write output folder", path_.string(), errno);
    }
}

}  // namespace drape
