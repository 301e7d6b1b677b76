#include "drape/error.h"
#include "scene/scene_rules.h"

namespace drape {

bool check_capsule(const Members& members, Collider&) {
    if (!members["radius"] || !members["radii"]) return true;
    return members.object().fail("expected radius or radii, got both");
}

bool check_mesh(const Members& members, Collider& collider) {
    if (!members.fit({"file", "scale", "shell"})) return false;
    Mesh& mesh = std::get<Mesh>(collider.shape);
    mesh.file = members["file"].file(mesh.file).string();
    try {
        read_file(mesh);
    } catch (const Error& error) {
        return members["file"].fail(error.what());
    }
    return true;
}

}  // namespace drape
