#include "cloth/together.h"

#include <algorithm>
#include <cstring>
#include <optional>

namespace drape {

namespace {

/// Particles: from there on a dispatch of a cloth alone costs little beside what it does (docs/devices.md).
constexpr std::uint64_t most_particles = 128 * 128;

bool alike(const Cloth& one, const Cloth& other) {
    Cloth same = other;
    same.name = one.name;
    same.placement = one.placement;
    same.velocity = one.velocity;
    same.pins = one.pins;
    same.appearance = one.appearance;
    return same == one;
}

/// Whether all of a step's data are its constants and the images of the state.
bool in_images(StepKind kind) {
    switch (kind) {
        case StepKind::wind:
        case StepKind::control:
        case StepKind::predict:
        case StepKind::force:
        case StepKind::explicit_step:
        case StepKind::bend:
        case StepKind::twist:
        case StepKind::spring:
        case StepKind::line:
        case StepKind::collide:
            return true;
        default:
            return false;
    }
}

bool same_constants(const StepConstants& one, const StepConstants& other) {
    return std::visit(
        [&](const auto& constants) {
            const auto* const others = std::get_if<std::decay_t<decltype(constants)>>(&other);
            return others && std::memcmp(&constants, others, sizeof constants) == 0;
        },
        one);
}

bool same_place(const Step& one, const Step& other) {
    return one.kind == other.kind && one.substep == other.substep && one.iteration == other.iteration &&
           one.last == other.last && one.count == other.count && one.conditional == other.conditional;
}

/// The steps of a list's cloths: a row per step of its first.
using Rows = std::vector<std::vector<const Step*>>;

std::optional<Rows> rows_of(const std::vector<Step>& steps, const std::vector<std::size_t>& list) {
    Rows rows;
    for (const std::size_t cloth : list) {
        std::size_t place = 0;
        for (const Step& step : steps) {
            if (step.cloth != cloth) continue;
            if (cloth == list.front()) rows.emplace_back();
            if (place == rows.size() || !same_place(cloth == list.front() ? step : *rows[place].front(), step))
                return {};
            rows[place++].push_back(&step);
        }
        if (place != rows.size()) return {};
    }
    return rows;
}

void add_row(const std::vector<const Step*>& row, std::vector<Step>& merged) {
    const Step& first = *row.front();
    const bool one = in_images(first.kind) && !first.conditional && std::ranges::all_of(row, [&](const Step* step) {
                         return same_constants(first.constants, step->constants);
                     });
    for (const Step* step : row) {
        merged.push_back(*step);
        merged.back().together = one;
        if (one) return;
    }
}

}  // namespace

std::vector<std::vector<std::size_t>> cloths_alike(const SceneDescription& scene) {
    std::vector<std::vector<std::size_t>> lists;
    const SolverSettings& solver = scene.solver;
    const bool own_iterations = solver.tolerance > 0 && solver.iterations > 1 && named(solver.method).iterates();
    if (!scene.cutters.empty() || own_iterations) return lists;
    for (std::size_t k = 0; k < scene.cloths.size(); ++k) {
        const Cloth& cloth = scene.cloths[k];
        if (cloth.self_collision || std::uint64_t{cloth.grid[0]} * cloth.grid[1] > most_particles) continue;
        const auto list = std::ranges::find_if(
            lists, [&](const std::vector<std::size_t>& each) { return alike(scene.cloths[each.front()], cloth); });
        if (list == lists.end())
            lists.push_back({k});
        else
            list->push_back(k);
    }
    std::erase_if(lists, [](const std::vector<std::size_t>& list) { return list.size() == 1; });
    return lists;
}

std::vector<Step> steps_together(const std::vector<Step>& steps, const std::vector<std::vector<std::size_t>>& lists) {
    std::vector<Rows> tables;
    std::vector<std::optional<std::size_t>> table_of;  // by cloth
    std::vector<bool> leads;
    for (const std::vector<std::size_t>& list : lists) {
        std::optional<Rows> rows = rows_of(steps, list);
        if (!rows) continue;
        for (const std::size_t cloth : list) {
            table_of.resize(std::max(table_of.size(), cloth + 1));
            leads.resize(table_of.size());
            table_of[cloth] = tables.size();
            leads[cloth] = cloth == list.front();
        }
        tables.push_back(std::move(*rows));
    }
    std::vector<Step> merged;
    std::vector<std::size_t> next(tables.size());
    for (const Step& step : steps) {
        const bool alone = step.cloth >= table_of.size() || !table_of[step.cloth];
        if (alone)
            merged.push_back(step);
        else if (leads[step.cloth])
            add_row(tables[*table_of[step.cloth]][next[*table_of[step.cloth]]++], merged);
    }
    return merged;
}

}  // namespace drape
