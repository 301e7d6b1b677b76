// A scene may name these checks under `oracles`. The reader, the schema and the document know their names, limits and
// meaning; run/scene_oracles.h judges them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drape/scene.h"
#include "scene/scene_format.h"

namespace drape {

struct OracleLimit {
    std::string_view name, help;
    bool counts = false;  ///< a whole number of frames, cloths, rows or pieces, not negative
};

struct OracleKind {
    std::string_view name, help;
    std::vector<OracleLimit> limits;  ///< all of them must be given
    /// Returns what the scene lacks for the check to say anything; empty: nothing.
    std::string_view (*obstacle)(const SceneDescription&);

    const OracleLimit* find_limit(std::string_view limit) const;
};

std::span<const OracleKind> oracle_kinds();
const OracleKind* find_oracle_kind(std::string_view name);
/// Returns an oracle's keys, `check` first, as an object of the format.
const Definition& oracle_definition(const OracleKind& kind);
/// Returns all checks as the keys of one object, for hints.
const Definition& oracle_names();

}  // namespace drape
