// A sweep is a scene, and a list of its values that change from run to run.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drape/scene_reader.h"
#include "sweep/distribution.h"

namespace drape::sweep {

inline constexpr std::uint32_t most_runs = 10'000'000;

/// The shares of the runs of a data set that are to train a model, to choose among models, and to judge the chosen one.
struct Split {
    double train = 0, validation = 0, test = 0;
};

struct SweepSpec {
    std::string scene;  ///< path, as it may be opened
    std::uint64_t seed = 0;
    std::uint32_t count = 0;                         ///< runs 0 .. count-1
    std::vector<std::string> set;                    ///< "/pointer=value", in every run, before the others
    std::map<std::string, Distribution> parameters;  ///< by JSON pointer
    std::optional<Split> split;                      ///< nothing: the runs are one whole
    std::string text;                                ///< the file's text

    /// Returns a run's parameters, by pointer, as JSON: a pure function of the specification and the index.
    std::map<std::string, std::string> parameters_of(std::uint32_t index) const;
    /// Returns "train", "validation" or "test": drawn for each run by itself, by the shares of the split; empty
    /// without.
    std::string_view part_of(std::uint32_t index) const;
    /// Returns all "/pointer=value" of a run, as --set takes them.
    std::vector<std::string> overrides_of(std::uint32_t index) const;
};

/// Reads a specification. Throws SceneFailure with every error, at its place, and OutputError when there is no such
/// file.
SweepSpec read_sweep(const std::string& path);
SweepSpec read_sweep_text(std::string_view text, const std::string& path);

}  // namespace drape::sweep
