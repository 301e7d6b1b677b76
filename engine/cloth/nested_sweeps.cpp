#include "cloth/nested_sweeps.h"

#include <algorithm>
#include <cstdlib>

namespace drape {

namespace {

using glsl::ivec2;
using glsl::ivec4;

/// Sweeps over the box of a radius around a pin.
struct NestedBlock {
    int radius, sweeps;
};

/// Beyond so many particle visits per particle of the cloth more substeps are cheaper.
constexpr double most_visits = 3;

/// Walks up to the largest box and back, with the smallest again and again. Boxes around inner particles have one line
/// less than a multiple of eight, those in corners a multiple: as many as a subgroup of the default device goes along
/// at a time. The last list is for 384 links and more. None where more substeps are cheaper.
std::vector<NestedBlock> nested_blocks(const Grid& grid) {
    const std::uint32_t links = std::max(grid.columns(), grid.rows()) - 1;
    if (links < 48) return {};
    if (links < 96) return {{7, 4}, {15, 1}, {7, 4}};
    if (links < 192) return {{7, 4}, {15, 2}, {7, 4}, {31, 1}, {7, 4}, {15, 2}, {7, 4}};
    if (links < 384)
        return {{7, 8}, {15, 4}, {7, 8}, {31, 4}, {7, 8}, {63, 2}, {7, 8}, {31, 4}, {7, 8}, {15, 4}, {7, 8}};
    return {{7, 8}, {15, 4}, {7, 8}, {31, 4}, {7, 8}, {63, 2}, {7, 8}, {127, 1},
            {7, 8}, {63, 2}, {7, 8}, {31, 4}, {7, 8}, {15, 4}, {7, 8}};
}

/// Held particles of the cloth without a held neighbour: column, row.
std::vector<ivec2> lone_pins(const ClothGeometry& cloth) {
    const ivec2 size = cloth.grid.size();
    const auto held = [&](int column, int row) {
        if (column < 0 || row < 0 || column >= size.x || row >= size.y) return false;
        const std::size_t particle =
            cloth.grid.particle(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row));
        return cloth.position[particle].w == 0 && cloth.free_weight[particle] > 0;
    };
    std::vector<ivec2> pins;
    for (int row = 0; row < size.y; ++row)
        for (int column = 0; column < size.x; ++column) {
            if (!held(column, row)) continue;
            int around = 0;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) around += held(column + dx, row + dy);
            if (around == 1) pins.push_back({column, row});
        }
    return pins;
}

double visits(const Grid& grid, ivec2 pin, const std::vector<NestedBlock>& blocks) {
    double sum = 0;
    for (const NestedBlock& block : blocks) {
        const auto extent = [radius = block.radius](int at, int count) {
            return std::min(at + radius, count - 1) - std::max(at - radius, 0) + 1;
        };
        sum += static_cast<double>(block.sweeps) * extent(pin.x, grid.size().x) * extent(pin.y, grid.size().y);
    }
    return sum;
}

/// Pins in rounds, within which the largest boxes share no particle.
std::vector<std::vector<ivec2>> rounds_of(const std::vector<ivec2>& pins, int radius) {
    std::vector<std::vector<ivec2>> rounds;
    for (const ivec2 pin : pins) {
        const auto apart = [&](const ivec2& other) {
            return std::max(std::abs(pin.x - other.x), std::abs(pin.y - other.y)) > 2 * radius;
        };
        const auto free = std::ranges::find_if(
            rounds, [&](const std::vector<ivec2>& round) { return std::ranges::all_of(round, apart); });
        if (free != rounds.end())
            free->push_back(pin);
        else
            rounds.push_back({pin});
    }
    return rounds;
}

/// The lines' constants by direction.
glsl::NestedPush nested_constants(const ClothGeometry& cloth, const MethodPlan& plan) {
    glsl::NestedPush push{};
    push.grid = cloth.grid.size();
    push.compression = cloth.compression;
    for (const MethodStep& step : plan.iterated) {
        const auto* line = std::get_if<glsl::LinePush>(&step.constants);
        if (!line || cloth.stiffness_constant.spring[static_cast<std::size_t>(line->channel)] == 0) continue;
        const auto set = [&](glsl::vec4& vector, float value) {
            (line->channel == 0   ? vector.x
             : line->channel == 1 ? vector.y
             : line->channel == 2 ? vector.z
                                  : vector.w) = value;
        };
        set(push.rest_length, line->rest_length);
        set(push.compliance, line->compliance);
        set(push.compliance_bdf2, line->compliance_bdf2);
        set(push.followed, line->followed);
        set(push.followed_bdf2, line->followed_bdf2);
    }
    return push;
}

}  // namespace

void add_nested_sweeps(const ClothGeometry& cloth, MethodPlan& plan) {
    const auto skip = [&](const char* reason) { plan.skipped.push_back({cloth.name + "/nested sweeps", reason}); };
    const std::vector<ivec2> pins = lone_pins(cloth);
    if (pins.empty()) return skip("no particle is held alone");
    glsl::NestedPush push = nested_constants(cloth, plan);
    if (!(push.rest_length.x > 0)) return skip("zero stiffness");
    const std::vector<NestedBlock> blocks = nested_blocks(cloth.grid);
    if (blocks.empty()) return skip("fewer than 48 links: more substeps are cheaper");
    double sum = 0;
    for (const ivec2 pin : pins) sum += visits(cloth.grid, pin, blocks);
    if (sum > most_visits * static_cast<double>(cloth.grid.particle_count()))
        return skip("so many lone pins: more substeps are cheaper");
    for (const auto& [radius, sweeps] : blocks) plan.nested_table.push_back({radius, sweeps, 0, 0});
    push.block_count = static_cast<int>(blocks.size());
    for (const std::vector<ivec2>& round : rounds_of(pins, std::ranges::max(blocks, {}, &NestedBlock::radius).radius)) {
        push.first_pin = static_cast<int>(plan.nested_table.size());
        for (const ivec2 pin : round) plan.nested_table.push_back({pin.x, pin.y, static_cast<int>(round.size()), 0});
        plan.iterated.push_back({StepKind::nested, push});
    }
}

}  // namespace drape
