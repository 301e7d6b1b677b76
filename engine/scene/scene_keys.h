// Every object of the scene format and the keys it may have. The reader refuses a key that is not here, and
// throws when it asks for one itself, so these tables are what the reader knows; a test holds them against
// scene.schema.json.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace drape {

enum class ObjectKind : std::uint8_t {
    scene,
    time,
    wind,
    gust,
    cloth,
    placement,
    stiffness,
    pin,
    motion_key,
    appearance,
    colliders,
    plane,
    sphere,
    box,
    ellipsoid,
    cutter,
    solver,
    camera,
    light,
    image,
    oracle
};

struct ObjectKeys {
    ObjectKind kind;
    std::string_view name;  ///< name of the definition in the schema; "scene" is the root
    std::span<const std::string_view> keys;
    bool open = false;  ///< further keys are allowed (their values are checked by the reader)
};

/// All tables, indexed by ObjectKind.
std::span<const ObjectKeys> scene_object_keys();
const ObjectKeys& keys_of(ObjectKind kind);
bool has_key(const ObjectKeys& object, std::string_view key);

/// The known key nearest to a misspelt one: edit distance at most 2 and less than the known key's length;
/// empty when there is none.
std::string_view nearest_key(const ObjectKeys& object, std::string_view misspelt);

}  // namespace drape
