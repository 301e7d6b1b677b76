// Keeps reference runs on disk, with their error estimates. A file that does not hold exactly what it should is treated
// as absent and written anew.
#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "reference/reference_run.h"

namespace drape {

/// Canonical text of a run: method with its version, sizes and fingerprint of the network, options, times. Numbers read
/// back exactly.
std::string reference_key(std::string_view method, const SpringNetwork& network, std::span<const double> times,
                          std::initializer_list<std::pair<std::string_view, double>> options);

struct CachedRun {
    ReferenceRun run;
    bool from_cache = false;
    std::string store_error;  ///< reason why a fresh run could not be kept; empty when it was
};

class ReferenceCache {
  public:
    /// Creates the folder. Throws std::filesystem::filesystem_error when that fails.
    explicit ReferenceCache(std::filesystem::path folder);

    /// Path of reference_<hash of the key>.bin in the folder.
    std::filesystem::path file_of(std::string_view key) const;

    /// Returns the run of a key; nothing when there is none, or when the file is damaged, of another version, or of
    /// another key with the same hash.
    std::optional<ReferenceRun> load(std::string_view key) const;

    /// Writes beside and renames, so that readers see the old file or the new one. Throws std::runtime_error.
    void store(std::string_view key, const ReferenceRun& run) const;

    /// `load`, else `compute` and `store`. A failure to store does not lose the run.
    CachedRun get(std::string_view key, const std::function<ReferenceRun()>& compute) const;

  private:
    std::filesystem::path folder_;
};

}  // namespace drape
