#include "solver/pass_kit.h"

#include <fmt/format.h>

#include <utility>

namespace drape {

namespace {

std::string suffix_of(StateSet set) {
    static constexpr std::array<const char*, state_set_count> suffixes = {"", " of the companion",
                                                                          " of the disturbed run"};
    return suffixes.at(static_cast<std::size_t>(set));
}

template <class Row>
std::string in_set(const std::string& name, const Row& row, StateSet set) {
    return row.life == FieldLife::state ? name + suffix_of(set) : name;
}

}  // namespace

std::string resource_name(const ClothModel& cloth, const FieldRow& row, StateSet set) {
    return resource_name(cloth.name, row, set);
}

std::string resource_name(const std::string& state, const FieldRow& row, StateSet set) {
    return in_set(state + "/" + std::string(row.name), row, set);
}

std::string resource_name(const ContactRow& row, StateSet set) { return in_set(resource_name(row), row, set); }

graph::BufferDeclaration in_set(graph::BufferDeclaration buffer, StateSet set) {
    buffer.name += suffix_of(set);
    return buffer;
}

graph::ImageDeclaration in_set(graph::ImageDeclaration image, StateSet set) {
    image.name += suffix_of(set);
    for (std::string& slice : image.slices) slice += suffix_of(set);
    return image;
}

void ClothState::turn() {
    for (const auto& [field, spare] : spare_fields) std::swap((*this)[field], (*this)[spare]);
    away = !away;
}

void ClothState::turn_displacement() { std::swap((*this)[Field::displacement], (*this)[Field::displacement_spare]); }

graph::PassName ClothState::pass_name(const std::string& pass, const std::string& stage) const {
    const std::string label = name + "/" + pass;
    return {label, stage, label};
}

graph::PassName ClothState::step_name(const std::string& pass, const Step& step) const {
    const std::string label = name + "/" + pass;
    return {fmt::format("{} (substep {}, iteration {})", label, step.substep, step.iteration), "simulate", label};
}

}  // namespace drape
