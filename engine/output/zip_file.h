#pragma once

#include <string>
#include <utility>
#include <vector>

#include "output/atomic_file.h"

namespace drape {

/// A ZIP archive of files, stored or deflated, which appears under its name complete or not at all. Its bytes depend on
/// its parts alone, since all dates are the same.
class ZipFile {
  public:
    ZipFile(OutputFolder& folder, std::string name, bool deflates)
        : file_(folder, std::move(name)), deflates_(deflates) {}

    void add(std::string part_name, std::string bytes) { parts_.push_back({std::move(part_name), std::move(bytes)}); }
    /// Adds a part with the content that `contents`, which must live until the commit, has at that time.
    void add(std::string part_name, const AtomicFile& contents) {
        parts_.push_back({std::move(part_name), {}, &contents});
    }

    /// Throws OutputError.
    FileRecord commit();

  private:
    struct Part {
        std::string name, bytes;
        const AtomicFile* contents = nullptr;  ///< in the place of bytes
    };

    AtomicFile file_;
    bool deflates_;
    std::vector<Part> parts_;
};

}  // namespace drape
