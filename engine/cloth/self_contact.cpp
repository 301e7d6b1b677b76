#include "cloth/self_contact.h"

#include <algorithm>
#include <cmath>

#include "cloth/flat_distance.h"
#include "cloth/sewing.h"
#include "world/contact_shape.h"

namespace drape {

namespace {

/// Returns how much farther (m) than necessary the search for cells looks. Cells of flat cloth that are no neighbours
/// are one spacing apart, and must not be found.
double search_margin(double spacing, double thickness) { return std::max(0.2 * spacing, 0.8 * (spacing - thickness)); }

/// Returns the spacings, m, along columns and rows of a flat cloth whose particles are at most as far apart as those of
/// this cloth at rest.
std::array<double, 2> densest_spacing(const ClothModel& model) {
    float least = 1;
    for (const glsl::vec4& scales : model.rest_scales)
        least = std::min({least, scales.x, scales.y, scales.z, scales.w});
    return {least * model.spacing[0], least * model.spacing[1]};
}

/// Returns the spacings, m, along columns and rows of a grid on which no primitives that share no corner are farther
/// apart than on the flat cloth.
std::array<double, 2> flat_spacing(const ClothModel& model) {
    if (model.panel.empty()) return densest_spacing(model);
    constexpr double rounding = 0.999;
    const double share = rounding * least_flat_share(model);
    return {share * model.spacing[0], share * model.spacing[1]};
}

double smaller_spacing(const ClothModel& model) { return std::ranges::min(densest_spacing(model)); }

int top_level(glsl::ivec2 grid) {
    int level = 0;
    while (self_tree_boxes_of(grid, level) > 1) ++level;
    return level;
}

/// Returns the friction coefficient between a cloth's layers, without its maps.
double friction_of(const Cloth& cloth) {
    return cloth.self_collision.value_or(SelfCollision{}).friction.value_or(cloth.friction);
}

/// Returns the thickness, m, between the layers of a cloth whose particle has this factor: the wanted one, limited by
/// what its grid allows. A thickness that the scene gives and no map changes is within this limit, except for rounding.
float layer_thickness(const Cloth& cloth, double spacing, float factor = 1) {
    const std::optional<double> asked = cloth.self_collision.value_or(SelfCollision{}).thickness;
    if (asked && cloth.particle_thickness.empty()) return static_cast<float>(*asked);
    return static_cast<float>(std::clamp(asked.value_or(cloth.thickness) * static_cast<double>(factor),
                                         least_self_thickness * spacing, most_self_thickness * spacing));
}

glsl::SelfCloth constants_of(const Cloth& cloth, const ClothModel& model) {
    const double spacing = smaller_spacing(model);
    glsl::SelfCloth constants{};
    constants.grid = model.grid.size();
    const auto [dx, dy] = flat_spacing(model);
    constants.spacing = {static_cast<float>(dx), static_cast<float>(dy)};
    constants.thickness = layer_thickness(cloth, spacing);
    constants.friction = static_cast<float>(friction_of(cloth));
    // In flat cloth, the nearest primitives that share no corner are the corner of a cell and the diagonal beside it.
    constants.least_flat = static_cast<float>(dx * dy / std::hypot(dx, dy));
    return constants;
}

/// Returns the mass of an inner particle, kg.
double particle_mass(const Cloth& cloth, const ClothModel& model) {
    return cloth.areal_density * model.spacing[0] * model.spacing[1];
}

/// At most this many pairs of cloths are led apart, since one invocation processes all of them; further pairs never
/// touch.
constexpr std::size_t most_crossed = 4096;

bool is_held(const Cloth& cloth) { return !cloth.pins.empty(); }

glsl::SelfCrossed parted(const SceneDescription& scene, const std::vector<ClothModel>& models,
                         const StartCrossing& crossing) {
    const auto mass = [&](std::size_t k) {
        return particle_mass(scene.cloths[k], models[k]) * static_cast<double>(models[k].grid.particle_count());
    };
    const bool first_held = is_held(scene.cloths[crossing.first]), second_held = is_held(scene.cloths[crossing.second]);
    const double share = mass(crossing.second) / (mass(crossing.first) + mass(crossing.second));
    const double first = first_held ? 0 : second_held ? 1 : share;
    const double second = second_held ? 0 : first_held ? 1 : 1 - share;
    const Vec3& way = crossing.way;
    return {{static_cast<float>(way[0]), static_cast<float>(way[1]), static_cast<float>(way[2]), 0},
            {static_cast<int>(crossing.first), static_cast<int>(crossing.second)},
            {static_cast<float>(first), static_cast<float>(second)}};
}

int stepped(int length) { return (length + self_sheet_step) / self_sheet_step * self_sheet_step; }

/// Places the cloths in shelves on a sheet that is about as wide as high. Returns the sheet's columns and rows.
glsl::ivec2 lay_out(std::vector<glsl::SelfCloth>& cloths) {
    double area = 0;
    int width = 0;
    for (const glsl::SelfCloth& cloth : cloths) {
        area += double(stepped(cloth.grid.x)) * stepped(cloth.grid.y);
        width = std::max(width, cloth.grid.x);
    }
    width = std::max(width, static_cast<int>(std::sqrt(area)));
    glsl::ivec2 sheet{0, 0}, next{0, 0};
    int shelf = 0;
    for (glsl::SelfCloth& cloth : cloths) {
        if (next.x + cloth.grid.x > width) {
            next = {0, next.y + shelf};
            shelf = 0;
        }
        cloth.first = next;
        sheet = {std::max(sheet.x, next.x + cloth.grid.x), std::max(sheet.y, next.y + cloth.grid.y)};
        next.x += stepped(cloth.grid.x);
        shelf = std::max(shelf, stepped(cloth.grid.y));
    }
    return sheet;
}

}  // namespace

SelfContact::SelfContact(const SceneDescription& scene, const std::vector<ClothModel>& models,
                         const std::vector<StartCrossing>& not_meeting)
    : crossed(not_meeting) {
    const std::size_t count = models.size();
    std::uint64_t particles = 0;
    double margin = 0, extent = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const Cloth& cloth = scene.cloths[k];
        glsl::SelfCloth& constants = cloths.emplace_back(constants_of(cloth, models[k]));
        constants.held = is_held(cloth) ? 1 : 0;
        constants.lightness =
            static_cast<float>(particle_mass(scene.cloths[0], models[0]) / particle_mass(cloth, models[k]));
        const double looks = search_margin(smaller_spacing(models[k]), constants.thickness);
        margin = k == 0 ? looks : std::min(margin, looks);
        extent = std::max(extent, largest_coordinate(cloth));
        push.thickness = std::max(push.thickness, constants.thickness);
        largest = {std::max(largest.x, constants.grid.x), std::max(largest.y, constants.grid.y)};
        particles += models[k].grid.particle_count();
        // With held cloth there is no common motion: held particles against which others are pressed must not seem to
        // move.
        const auto is_hand = [](const DynamicPin& pin) { return pin.hand.has_value(); };
        if (std::ranges::any_of(cloth.pins, [](const Pin& pin) { return !pin.release; }) ||
            std::ranges::any_of(models[k].dynamic_pins, is_hand))
            held = true;
        for (std::size_t other = 0; other < count; ++other)
            meetings.push_back(k != other || cloth.self_collision ? glsl::self_meets : glsl::self_meets_not);
    }
    for (const StartCrossing& each : crossed) {
        if (each.first == each.second) continue;
        glsl::uint meeting = glsl::self_meets_not;
        if (is_worked_apart(each) && to_part.size() < most_crossed) {
            meeting = glsl::self_meets_apart + static_cast<glsl::uint>(to_part.size());
            to_part.push_back(parted(scene, models, each));
        }
        meetings[each.first * count + each.second] = meetings[each.second * count + each.first] = meeting;
    }
    push.crossed_count = static_cast<int>(to_part.size());
    push.grid = lay_out(cloths);
    push.step = static_cast<float>(models[0].substep_length);
    push.least = static_cast<float>(2e-6 * extent);  // a few roundings of the coordinates
    push.margin = static_cast<float>(margin);
    const auto places =
        static_cast<std::uint32_t>(particles);  // scene_particle_limit times the size of an entry does not overflow
    capacity = {places * capacity_per_particle.pairs, places * capacity_per_particle.near,
                places * capacity_per_particle.cells, places * capacity_per_particle.touching};
    push.top = top_level(push.grid);
    push.cloth_count = static_cast<int>(count);
    push.member_size = push.grid;
    for (glsl::SelfCloth& cloth : cloths) {
        cloth.least = push.least;
        cloth.largest = push.thickness;
        cloth.body = static_cast<int>(&cloth - cloths.data());
    }
    lay_seams(scene, models);
    push.cloth = cloths.front();
    lay_skins(scene, models);
}

SelfContact::SelfContact(const std::vector<const SelfContact*>& members)
    : push(members.front()->push),
      capacity{},
      largest(members.front()->largest),
      held(members.front()->held),
      member_count(members.size()),
      meetings(members.front()->meetings) {
    const glsl::ivec2 own = push.grid;
    const int count = static_cast<int>(members.size());
    // If a member has only one cloth, this covers its rectangle of the sheet (shaders/include/self_cloths.h).
    if (count > 1) push.member_size = {stepped(own.x), stepped(own.y)};
    const int across =
        std::clamp(static_cast<int>(std::sqrt(double(count) * push.member_size.y / push.member_size.x)), 1, count);
    push.grid = {across * push.member_size.x, ((count - 1) / across + 1) * push.member_size.y};
    push.top = top_level(push.grid);
    push.cloth_count = static_cast<int>(member_count * members.front()->cloths.size());
    if (!members.front()->skins.empty()) skins.resize(place_count());
    for (int k = 0; k < count; ++k) {
        const SelfContact& member = *members[static_cast<std::size_t>(k)];
        const glsl::ivec2 corner{k % across * push.member_size.x, k / across * push.member_size.y};
        push.thickness = std::max(push.thickness, member.push.thickness);
        push.least = std::max(push.least, member.push.least);
        push.margin = std::min(push.margin, member.push.margin);
        const int first_cloth = static_cast<int>(cloths.size());
        for (glsl::SelfCloth cloth : member.cloths) {
            cloth.first = {corner.x + cloth.first.x, corner.y + cloth.first.y};
            cloth.body += first_cloth;
            cloths.push_back(cloth);
        }
        capacity.add(member.capacity);
        for (std::size_t place = 0; place < member.skins.size(); ++place) {
            const auto columns = std::size_t(own.x);
            const std::size_t column = std::size_t(corner.x) + place % columns,
                              row = std::size_t(corner.y) + place / columns;
            skins[row * std::size_t(push.grid.x) + column] = member.skins[place];
        }
    }
    push.cloth = cloths.front();
}

int SelfContact::place_of(std::size_t cloth, std::size_t particle) const {
    const glsl::SelfCloth& laid = cloths[cloth];
    const auto own = static_cast<int>(particle);
    return (laid.first.y + own / laid.grid.x) * push.grid.x + laid.first.x + own % laid.grid.x;
}

void SelfContact::lay_seams(const SceneDescription& scene, const std::vector<ClothModel>& models) {
    const SeamCover cover(scene);
    if (cover.cloths.empty()) return;
    sewn.resize(place_count());
    for (std::size_t place = 0; place < sewn.size(); ++place) sewn[place] = {static_cast<int>(place), -1, 0, 0, 0};
    for (std::size_t k = 0; k < cloths.size(); ++k) {
        glsl::SelfCloth& cloth = cloths[k];
        cloth.body = static_cast<int>(cover.cloths[k].body);
        for (std::size_t other = 0; other < cloths.size(); ++other)
            if (cover.are_sewn(k, other) && is_held(scene.cloths[other])) cloth.held = 1;
        for (std::size_t particle = 0; particle < models[k].grid.particle_count(); ++particle)
            sewn[std::size_t(place_of(k, particle))].thickness = cloth.thickness;
    }
    lay_triangles(cover, closing_times(scene));
    lay_followers(cover);
    const std::vector<double> masses = sewn_masses(scene);
    for (std::size_t station = 0; station < masses.size(); ++station)
        for (const SewnMember& member : cover.sewing.stations[station].group)
            sewn[std::size_t(place_of(member.cloth, member.particle))].inverse_mass =
                static_cast<float>(particle_mass(scene.cloths[member.cloth], models[member.cloth]) / masses[station]);
}

void SelfContact::lay_triangles(const SeamCover& cover, const std::vector<double>& closings) {
    for (std::size_t k = 0; k < cloths.size(); ++k) {
        const SeamCover::OfCloth& own = cover.cloths[k];
        const auto cells = static_cast<std::size_t>(cloths[k].grid.x - 1);
        for (std::size_t cell = 0; cell < own.never.size(); ++cell) {
            const std::size_t particle = cell / cells * (cells + 1) + cell % cells;
            glsl::uint& bits = sewn[std::size_t(place_of(k, particle))].left_out;
            bits = own.never[cell] | own.closing[cell] << 2;
            if (own.closing[cell] == 0) continue;
            const auto closing = std::ranges::find(closings, own.until[cell]);
            bits |= static_cast<glsl::uint>(closing - closings.begin()) << 4;
        }
    }
}

void SelfContact::lay_followers(const SeamCover& cover) {
    const auto follow = [&](const SewnGroup& group) {
        if (group.size() < 2) return;
        sewn_leaders.push_back(place_of(group.front().cloth, group.front().particle));
        float thickness = sewn[std::size_t(sewn_leaders.back())].thickness;
        int before = -1;
        for (const SewnMember& member : group)
            thickness = std::min(thickness, sewn[std::size_t(place_of(member.cloth, member.particle))].thickness);
        for (const SewnMember& member : group) {
            const int place = place_of(member.cloth, member.particle);
            if (before >= 0) sewn[std::size_t(before)].next = place;
            sewn[std::size_t(place)].leader = sewn_leaders.back();
            sewn[std::size_t(place)].thickness = thickness;
            before = place;
        }
    };
    for (const SewnStation& station : cover.sewing.stations) follow(station.group);
    for (const SewnBetween& each : cover.sewing.between) follow(each.group);
    push.sewn_count = static_cast<int>(sewn_leaders.size());
}

void SelfContact::lay_skins(const SceneDescription& scene, const std::vector<ClothModel>& models) {
    if (std::ranges::none_of(scene.cloths, has_skin)) return;
    skins.resize(place_count());
    for (std::size_t k = 0; k < cloths.size(); ++k) {
        const Cloth& cloth = scene.cloths[k];
        const glsl::SelfCloth& laid = cloths[k];
        const auto columns = std::size_t(laid.grid.x);
        for (std::size_t particle = 0; particle < models[k].grid.particle_count(); ++particle) {
            const float thickness =
                layer_thickness(cloth, smaller_spacing(models[k]), thickness_factor(cloth, particle));
            const double friction = friction_of(cloth) * static_cast<double>(friction_factor(cloth, particle));
            const std::size_t column = std::size_t(laid.first.x) + particle % columns,
                              row = std::size_t(laid.first.y) + particle / columns;
            skins[row * std::size_t(push.grid.x) + column] = {thickness, static_cast<float>(std::sqrt(friction))};
        }
    }
}

std::size_t SelfContact::member_of(glsl::ivec2 texel) const {
    const int across = push.grid.x / push.member_size.x;
    const int member = texel.y / push.member_size.y * across + texel.x / push.member_size.x;
    return static_cast<std::size_t>(member);
}

std::vector<int> SelfContact::owners() const {
    std::vector<int> all(place_count(), -1);
    for (std::size_t k = 0; k < cloths.size(); ++k)
        for (int row = 0; row < cloths[k].grid.y; ++row) {
            const auto begin =
                std::size_t(cloths[k].first.y + row) * std::size_t(push.grid.x) + std::size_t(cloths[k].first.x);
            std::fill_n(all.begin() + static_cast<std::ptrdiff_t>(begin), cloths[k].grid.x, static_cast<int>(k));
        }
    return all;
}

glsl::SelfClothPush SelfContact::cloth_push(std::size_t cloth, std::uint32_t substep, std::size_t closings) const {
    const glsl::SelfCloth& laid = cloths[cloth];
    const std::size_t each = cloths_each();
    const bool is_last = (cloth + 1) % each == 0;
    return {laid.grid,
            laid.first,
            push.grid,
            is_last ? static_cast<int>(each) : 0,
            held ? 1 : 0,
            substep == 0 ? 1 : 0,
            laid.thickness,
            static_cast<int>(cloth / each),
            static_cast<int>(member_count),
            static_cast<int>(substep * closings),
            laid.body};
}

void ContactCapacity::add(const ContactCapacity& other) {
    const auto sum = [](std::uint32_t& own, std::uint32_t more) {
        own = static_cast<std::uint32_t>(std::min<std::uint64_t>(std::uint64_t{own} + more, most_contact_entries));
    };
    sum(pairs, other.pairs);
    sum(near, other.near);
    sum(cells, other.cells);
    sum(touching, other.touching);
}

double self_list_use(const ContactCapacity& capacity, const glsl::SelfRecord& record) {
    const auto use = [](std::uint32_t most, std::uint32_t entries) { return static_cast<double>(most) / entries; };
    return std::max({use(record.most_pairs, capacity.pairs), use(record.most_near, capacity.near),
                     use(record.most_cells, capacity.cells), use(record.most_touching, capacity.touching)});
}

ContactCapacity grown_capacity(const ContactCapacity& capacity, const glsl::SelfRecord& record) {
    const auto more = [](std::uint32_t most, std::uint32_t entries) {
        const std::uint64_t wanted = std::max(std::uint64_t{entries} * 2, std::uint64_t{most} + most / 4);
        return most <= entries ? entries
                               : static_cast<std::uint32_t>(std::min<std::uint64_t>(wanted, most_contact_entries));
    };
    return {more(record.most_pairs, capacity.pairs), more(record.most_near, capacity.near),
            more(record.most_cells, capacity.cells), more(record.most_touching, capacity.touching)};
}

std::uint32_t self_tree_boxes_of(glsl::ivec2 grid, int level) {
    const auto nodes = [level](int particles) { return static_cast<std::uint32_t>(((particles - 1) >> level) + 1); };
    return nodes(grid.x) * nodes(grid.y);
}

std::uint64_t self_tree_boxes(glsl::ivec2 grid) {
    std::uint64_t count = 0;
    for (int level = 0; level <= top_level(grid); ++level) count += self_tree_boxes_of(grid, level);
    return count;
}

}  // namespace drape
