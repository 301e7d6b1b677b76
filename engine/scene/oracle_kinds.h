// The checks that a scene may name under `oracles`: their names, limits and meaning, as the reader, the schema and the
// document know them. How they are judged: verify/scene_oracles.h.
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
    bool counts = false;  ///< frames, cloths, rows or pieces: a whole number, not negative
};

struct OracleKind {
    std::string_view name, help;
    std::vector<OracleLimit> limits;  ///< all of them must be given
    /// What the scene lacks for the check to say anything; empty: nothing.
    std::string_view (*obstacle)(const SceneDescription&);

    const OracleLimit* find_limit(std::string_view limit) const;
};

std::span<const OracleKind> oracle_kinds();
/// Nothing where there is none of that name.
const OracleKind* find_oracle_kind(std::string_view name);
/// An oracle's keys, `check` first, as an object of the format.
const Definition& oracle_definition(const OracleKind& kind);
/// All checks as the keys of one object: for hints.
const Definition& oracle_names();

}  // namespace drape
