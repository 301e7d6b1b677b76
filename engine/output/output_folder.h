#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "base/output_error.h"
#include "base/printable_text.h"
#include "output/file_descriptor.h"

namespace drape {

inline constexpr std::string_view manifest_file_name = "manifest.json";
// The manifest's "format" key has this value, by which a later run knows that a manifest.json is drape's.
inline constexpr std::string_view manifest_format = "drape manifest 1";

// How a folder that is not empty is treated. Unfinished files of killed runs do not count, and are removed in any case.
enum class ExistingFiles {
    refuse,
    overwrite,  // remove what an earlier run wrote, and keep every other file
    resume,     // keep the earlier run's files, except its manifest ("done"), its unfinished temporaries, and files of
                // single frames that do not say which run they are of
};

// The folder of one run. While this object lives the folder is locked against other drape processes and files in it are
// reached through its descriptor, so that renaming the folder or changing the working directory does no harm.
// The constructor checks everything (kind, lock, content, writability) and changes nothing but creating a missing
// folder and its missing parents, which are removed again when it throws, or when the object ends and no file was
// written. An earlier run's files go at the first write, not before: a run that fails while starting loses nothing. It
// also ignores SIGXFSZ unless the program handles it, so that a file size limit arrives as an error, not as a death.
class OutputFolder {
  public:
    // Throws OutputError.
    explicit OutputFolder(const std::filesystem::path& path, ExistingFiles existing = ExistingFiles::refuse);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    // Returns the path of the file of this name, for messages.
    std::string path_of(std::string_view name) const { return printable((path_ / name).string()); }
    int descriptor() const { return descriptor_.get(); }

    // Returns false on a file system that cannot lock folders (some network ones): two processes are then not kept
    // apart.
    bool is_locked() const { return is_locked_; }

    // Returns the earlier run's files that the first write removes, sorted; unless overwriting or resuming only
    // unfinished ones.
    const std::vector<std::string>& files_to_remove() const { return files_to_remove_; }

    bool has_file(const std::string& name) const;
    // Returns the sorted names of everything in the folder that is no folder itself. Throws OutputError.
    std::vector<std::string> file_names() const;
    // Returns the whole file; refuses a symbolic link or anything else that is no regular file. Throws OutputError.
    std::vector<std::uint8_t> read_file(const std::string& name) const;

    // Throws OutputError where it is known that so many bytes more will not fit, with what files_to_remove() take as
    // room. On a file system whose free space says less of that (network, copy on write, unknown) never, or only where
    // no compression would help.
    void expect_room(std::uint64_t bytes) const;

    // Removes files_to_remove() once. Every writer calls it; any thread may. Throws OutputError.
    void begin_writing();

    // Makes the renames so far survive a power cut. Throws OutputError.
    void sync() const;

  private:
    void create_missing_folders();
    void remove_created_folders() noexcept;
    void open_and_lock();
    void check_content(ExistingFiles existing);
    void check_writable() const;

    std::filesystem::path path_;
    std::vector<std::filesystem::path> created_folders_;  // absolute, outermost first
    FileDescriptor descriptor_;
    bool is_locked_ = false;
    std::vector<std::string> files_to_remove_;
    std::mutex writing_mutex_;
    bool writing_begun_ = false;
};

// Returns whether a name stays in its folder: it is not empty, "." or "..", and has no '/'.
bool is_plain_file_name(std::string_view name);

// Return whether the program gives this name to files (of its formats, or manifest.json), or to temporary files while
// it writes them.
bool is_output_file_name(std::string_view name);
bool is_temporary_file_name(std::string_view name);

// Returns whether this is the temporary name of any file, by a process that no longer runs here.
bool is_left_over(std::string_view name);

}  // namespace drape
