#include "cloth/nested_boxes.h"

#include <algorithm>
#include <cstdlib>

#include "cloth/directions.h"
#include "shared/nested_types.h"

namespace drape {

namespace glsl {
#include "include/nested.h"
}  // namespace glsl

namespace {

using glsl::ivec2;

/// The iterations of a block relax the box of particles within `radius` columns and rows of a pin.
struct NestedBlock {
    ivec2 radius;
    int iterations;
};

/// Above this number of visits per particle of the cloth, more substeps are cheaper.
constexpr double most_visits = 3;

/// A strip has at most this many rows on either side of a pin, so that all blocks together stay below most_loop_rounds.
constexpr int longest_strip = 1024;

/// Returns boxes that grow to the largest and shrink again, with the smallest repeated many times, and once the strip
/// around the pin's column, which carries far more than the columns beside it, all the way down. Boxes around inner
/// particles have one line less than a multiple of eight, those in corners exactly a multiple: as many lines as a
/// subgroup of the default device follows at a time. The list is empty where more substeps are cheaper
/// (docs/solvers.md, "Nested boxes at lone pins").
std::vector<NestedBlock> nested_blocks(const Grid& grid) {
    const auto box = [](int radius, int iterations) { return NestedBlock{{radius, radius}, iterations}; };
    const NestedBlock strip{{7, std::min(grid.size().y, longest_strip)}, 1};
    const std::uint32_t links = std::max(grid.columns(), grid.rows()) - 1;
    if (links < 48) return {};
    if (links < 96) return {strip, box(7, 3), box(15, 1), box(7, 3)};
    if (links < 192) return {box(7, 4), box(15, 1), box(7, 4), box(31, 1), strip, box(7, 4), box(15, 2), box(7, 4)};
    if (links < 384)
        return {strip,      box(7, 8), box(15, 4), box(7, 8), box(31, 2), box(7, 8),
                box(63, 1), box(7, 8), box(31, 2), box(7, 8), box(15, 4), box(7, 8)};
    return {strip,       box(7, 8), box(15, 4), box(7, 8), box(31, 2), box(7, 8), box(63, 1), box(7, 8),
            box(127, 1), box(7, 8), box(63, 1), box(7, 8), box(31, 2), box(7, 8), box(15, 4), box(7, 8)};
}

/// Returns the held particles of the cloth that have no held neighbour: column, row.
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
        const ivec2 size = glsl::nested_box(pin, block.radius, grid.size()).size;
        sum += static_cast<double>(block.iterations) * size.x * size.y;
    }
    return sum;
}

/// Returns whether no block around one pin shares a particle with a block around the other.
bool apart(ivec2 pin, ivec2 other, const std::vector<NestedBlock>& blocks) {
    const ivec2 distance{std::abs(pin.x - other.x), std::abs(pin.y - other.y)};
    return std::ranges::all_of(blocks, [&](const NestedBlock& a) {
        return std::ranges::all_of(blocks, [&](const NestedBlock& b) {
            return distance.x > a.radius.x + b.radius.x || distance.y > a.radius.y + b.radius.y;
        });
    });
}

/// Returns the pins grouped in rounds; within a round, the blocks of different pins share no particle.
std::vector<std::vector<ivec2>> rounds_of(const std::vector<ivec2>& pins, const std::vector<NestedBlock>& blocks) {
    std::vector<std::vector<ivec2>> rounds;
    for (const ivec2 pin : pins) {
        const auto free = std::ranges::find_if(rounds, [&](const std::vector<ivec2>& round) {
            return std::ranges::all_of(round, [&](ivec2 other) { return apart(pin, other, blocks); });
        });
        if (free != rounds.end())
            free->push_back(pin);
        else
            rounds.push_back({pin});
    }
    return rounds;
}

/// Returns the constants of the lines by direction.
glsl::NestedPush nested_constants(const ClothGeometry& cloth, const MethodScheme& scheme) {
    glsl::NestedPush push{};
    push.grid = cloth.grid.size();
    push.compression = cloth.compression;
    for (const MethodStep& step : scheme.iterated) {
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

void add_nested_boxes(const ClothGeometry& cloth, const MethodSettings& settings, MethodScheme& scheme) {
    const auto skip = [&](const char* reason) { scheme.skipped.push_back({cloth.name + "/nested boxes", reason}); };
    const std::vector<ivec2> pins = lone_pins(cloth);
    if (pins.empty()) return skip("no particle is held alone");
    if (!costs_of(settings.device).nested_boxes) return skip("on such a device more substeps are cheaper");
    glsl::NestedPush push = nested_constants(cloth, scheme);
    if (!(push.rest_length.x > 0)) return skip("zero stiffness");
    const std::vector<NestedBlock> blocks = nested_blocks(cloth.grid);
    if (blocks.empty()) return skip("fewer than 48 links: more substeps are cheaper");
    double sum = 0;
    for (const ivec2 pin : pins) sum += visits(cloth.grid, pin, blocks);
    if (sum > most_visits * static_cast<double>(cloth.grid.particle_count()))
        return skip("so many lone pins: more substeps are cheaper");
    for (const auto& [radius, iterations] : blocks) scheme.nested_table.push_back({radius.x, radius.y, iterations, 0});
    push.block_count = static_cast<int>(blocks.size());
    for (const std::vector<ivec2>& round : rounds_of(pins, blocks)) {
        push.first_pin = static_cast<int>(scheme.nested_table.size());
        for (const ivec2 pin : round) scheme.nested_table.push_back({pin.x, pin.y, static_cast<int>(round.size()), 0});
        scheme.iterated.push_back({StepKind::nested, push});
    }
}

std::uint64_t nested_rounds(const MethodScheme& scheme, const glsl::NestedPush& push, ivec2 pin, int width) {
    std::uint64_t rounds = 0;
    for (int block = 0; block < push.block_count; ++block) {
        const glsl::ivec4& entry = scheme.nested_table[static_cast<std::size_t>(block)];
        const ivec2 size = glsl::nested_box(pin, {entry.x, entry.y}, push.grid).size;
        for (const SpringDirection& direction : spring_directions) {
            const int lines = direction.offset.y == 0 ? size.y : size.x;
            const int particles = direction.offset.y == 0 ? size.x : size.y;
            rounds += static_cast<std::uint64_t>(entry.z) * ((lines + width - 1) / width) * (2 * particles + 2);
        }
    }
    return rounds;
}

}  // namespace drape
