#include "solver/pass_kit.h"

#include <fmt/format.h>

#include <utility>

namespace drape {

std::string resource_name(const ClothModel& cloth, const FieldRow& row) {
    return cloth.name + "/" + std::string(row.name);
}

std::string resource_name(const ClothState& whole, const FieldRow& row) {
    return whole.name + "/" + std::string(row.name);
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
