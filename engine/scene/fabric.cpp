#include "drape/fabric.h"

#include <fmt/format.h>

#include "scene/nearest_word.h"
#include "scene/scene_rules.h"

namespace drape {

std::string directions_text(const WarpWeft& each) {
    if (each == WarpWeft(each.warp)) return fmt::format("{}", each.warp);
    return fmt::format(R"({{"warp": {}, "weft": {}}})", each.warp, each.weft);
}

std::string directions_text(const Rigidity& each) {
    if (each == Rigidity(each.warp)) return fmt::format("{}", each.warp);
    return fmt::format(R"({{"warp": {}, "weft": {}, "twist": {}}})", each.warp, each.weft, each.twist);
}

ValueText fabric_text() {
    ValueText text{"\"enum\": [", ""};
    for (const Fabric& fabric : fabrics) {
        const bool first = &fabric == fabrics;
        text.schema += (first ? "" : ", ") + quoted(fabric.name);
        text.words += fmt::format("{}`{}`", first ? "" : ", ", quoted(fabric.name));
    }
    text.schema += "]";
    return text;
}

std::string_view fabric_help() {
    static const std::string help = [] {
        std::string text =
            "Sets areal_density, stiffness, friction, and the appearance's roughness and sheen (estimated), each of "
            "which may still be given to override it. Absent: their own defaults.";
        for (const Fabric& fabric : fabrics)
            text += fmt::format(
                " {}: {} kg/m^2, stretch {}, shear {} N/m, bend {} N m, friction {}, roughness {}, sheen {}. "
                "{}",
                fabric.name, fabric.areal_density, directions_text(fabric.stiffness.stretch), fabric.stiffness.shear,
                directions_text(fabric.stiffness.bend), fabric.friction, fabric.roughness, fabric.sheen, fabric.source);
        return text;
    }();
    return help;
}

bool read_fabric(const SceneNode& node, Cloth& cloth) {
    std::string name;
    if (!node) return true;
    if (!node.read(name)) return false;
    if (const Fabric* fabric = find_fabric(name)) {
        set_fabric(cloth, *fabric);
        return true;
    }
    std::vector<std::string_view> names;
    for (const Fabric& fabric : fabrics) names.push_back(fabric.name);
    const std::string_view nearest = nearest_word(name, names);
    std::string expected;
    for (const std::string_view each : names)
        if (nearest.empty() || each == nearest) expected += (expected.empty() ? "" : " or ") + quoted(each);
    return node.fail_expected(expected);
}

void note_fabric(const SceneNode& cloth) {
    const SceneNode name = cloth.member("fabric"), stiffness = cloth.member("stiffness"),
                    look = cloth.member("appearance");
    const Fabric* fabric = name && name.value()->isString() ? find_fabric(name.value()->asString()) : nullptr;
    if (!fabric) return;
    const Stiffness& springs = fabric->stiffness;
    const auto number = [](double value) { return fmt::format("{}", value); };
    cloth.note_default("areal_density", number(fabric->areal_density));
    cloth.note_default("friction", number(fabric->friction));
    cloth.note_default("appearance",
                       fmt::format(R"({{"roughness": {}, "sheen": {}}})", fabric->roughness, fabric->sheen));
    if (look && look.value()->isObject()) {
        look.note_default("roughness", number(fabric->roughness));
        look.note_default("sheen", number(fabric->sheen));
    }
    const std::string stretch = directions_text(springs.stretch), bend = directions_text(springs.bend);
    cloth.note_default("stiffness",
                       fmt::format(R"({{"stretch": {}, "shear": {}, "bend": {}}})", stretch, springs.shear, bend));
    if (!stiffness || !stiffness.value()->isObject()) return;
    stiffness.note_default("stretch", stretch);
    stiffness.note_default("shear", number(springs.shear));
    stiffness.note_default("bend", bend);
}

}  // namespace drape
