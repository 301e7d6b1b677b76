#include "cloth/contact_state.h"

#include <cstring>
#include <tuple>

namespace drape {

namespace contact_rows {
namespace {

using glsl::layout_of;
using Context = const ContactContext&;

bool always(Context) { return true; }
bool has_skins(Context c) { return !c.contact.skins.empty(); }
bool sewn(Context c) { return c.contact.is_sewn(); }
bool crossed(Context c) { return !c.contact.to_part.empty(); }

FieldExtent sheet(Context c) {
    const glsl::ivec2 grid = c.contact.push.grid;
    return {static_cast<std::uint64_t>(grid.x), static_cast<std::uint64_t>(grid.y)};
}
FieldExtent places(Context c) { return {c.contact.place_count()}; }
FieldExtent cloths(Context c) { return {c.contact.cloths.size()}; }
FieldExtent crossed_list(Context c) { return {c.contact.to_part.size()}; }
FieldExtent cell_list(Context c) { return {c.capacity.cells}; }

std::vector<ContactRow> rows() {
    using enum FieldLife;
    using enum FieldView;
    using enum ContactField;
    const auto &vector = layout_of<glsl::vec4>(), &pair = layout_of<glsl::ivec2>(), &integer = layout_of<glsl::uint>(),
               &box = layout_of<glsl::SelfBox>();
    return {
        {owners, "owners", buffer, layout_of<int>(), constant, always, places,
         [](Context c) { return bytes_of_list(c.contact.owners()); }},
        {ContactField::cloths, "cloths", buffer, layout_of<glsl::SelfCloth>(), constant, always, contact_rows::cloths,
         [](Context c) { return bytes_of_list(c.contact.cloths); }},
        {skins, "skins", buffer, layout_of<glsl::vec2>(), constant, has_skins, places,
         [](Context c) { return bytes_of_list(c.contact.skins); }},
        {sewn_corners, "sewn corners", buffer, layout_of<glsl::SelfSewn>(), constant, sewn, places,
         [](Context c) { return bytes_of_list(c.contact.sewn); }},
        {sewn_leaders, "sewn leaders", buffer, layout_of<int>(), constant, sewn,
         [](Context c) { return FieldExtent{c.contact.sewn_leaders.size()}; },
         [](Context c) { return bytes_of_list(c.contact.sewn_leaders); }},
        {meetings, "meetings", buffer, integer, constant, always,
         [](Context c) { return FieldExtent{c.contact.meetings.size()}; },
         [](Context c) { return bytes_of_list(c.contact.meetings); }},
        {ContactField::crossed, "crossed", buffer, layout_of<glsl::SelfCrossed>(), constant, contact_rows::crossed,
         crossed_list, [](Context c) { return bytes_of_list(c.contact.to_part); }},
        {crossings, "crossings", buffer, layout_of<glsl::SelfCrossings>(), device, contact_rows::crossed, crossed_list},
        {led, "led", buffer, vector, device, contact_rows::crossed, contact_rows::cloths},
        {positions, "positions", image_and_buffer, vector, device, always, sheet},
        {displacements, "displacements", image_and_buffer, vector, device, always, sheet},
        {last_motions, "last motions", image_and_buffer, vector, device, always, sheet},
        {boxes, "boxes", texel_buffer, box, device, always, places},
        {kept, "kept", texel_buffer, box, device, always,
         [](Context c) { return FieldExtent{self_tree_boxes(c.contact.push.grid)}; }},
        {blocks, "blocks", buffer, pair, device, always, cell_list},
        {candidates, "candidates", buffer, pair, device, always, cell_list},
        {cells, "cells", buffer, pair, device, always, cell_list},
        {near, "near", buffer, integer, device, always, [](Context c) { return FieldExtent{c.capacity.near}; }},
        {pairs, "pairs", buffer, layout_of<glsl::uvec4>(), device, always,
         [](Context c) { return FieldExtent{c.capacity.pairs}; }},
        {touching, "touching", buffer, layout_of<glsl::SelfTouch>(), device, always,
         [](Context c) { return FieldExtent{c.capacity.touching}; }},
        {borne, "borne", buffer, layout_of<glsl::SelfBorne>(), state, always,
         [](Context c) { return FieldExtent{c.capacity.touching + std::uint64_t{1}}; }},
        {first_borne, "first borne", buffer, integer, device, always,
         [](Context c) { return FieldExtent{c.contact.place_count() * glsl::self_chains}; }},
        {sums, "sums", texel_buffer, layout_of<glsl::uvec4>(), device, always,
         [](Context c) { return FieldExtent{c.contact.place_count() * glsl::self_sum_count * 2}; }},
        {supports, "supports", texel_buffer, vector, device, always,
         [](Context c) { return FieldExtent{c.contact.place_count() * 2}; }},
        {before, "before", texel_buffer, vector, device, always, places},
        {velocities, "velocities", texel_buffer, vector, device, always, places},
        {made_good, "made good", texel_buffer, vector, device, always, places},
        {led_ways, "led ways", texel_buffer, vector, device, always, places},
        {shares, "shares", buffer, integer, device, always,
         [](Context c) { return FieldExtent{c.contact.place_count() * glsl::self_rounds}; }},
        {cloth_shares, "cloth shares", buffer, integer, device, always,
         [](Context c) { return FieldExtent{c.contact.cloths.size() * std::uint64_t{glsl::self_cloth_words}}; }},
        {record, "record", buffer, layout_of<glsl::SelfRecord>(), device, always,
         [](Context c) { return FieldExtent{c.contact.member_count}; }},
        {sizes, "sizes", buffer, layout_of<glsl::uvec4>(), device, always,
         [](Context) { return FieldExtent{glsl::self_size_count}; }},
    };
}

}  // namespace
}  // namespace contact_rows

std::span<const ContactRow> contact_fields() {
    static const std::vector<ContactRow> table = contact_rows::rows();
    return table;
}

std::optional<ContactField> contact_field_called(std::string_view variable) {
    static const auto fields = fields_by_variable(contact_fields());
    return found_in(fields, variable);
}

std::string resource_name(const ContactRow& row) { return "contact " + std::string(row.name); }

std::vector<std::byte> borne_state(std::vector<glsl::SelfBorne> list) {
    list.resize(std::min<std::size_t>(list.size(), list.front().corners.x + std::size_t{1}));
    list.front() = {{static_cast<glsl::uint>(list.size() - 1), 0, 0, 0}, {}};
    for (glsl::SelfBorne& entry : list) entry.force.w &= 1;
    std::ranges::sort(std::span(list).subspan(1), {}, [](const glsl::SelfBorne& entry) {
        const glsl::uvec4& all = entry.corners;
        return std::tuple(all.x, all.y, all.z, all.w, entry.force.w);
    });
    return bytes_of_list(list);
}

std::uint32_t borne_count(std::span<const std::byte> bytes) {
    std::uint32_t count = 0;
    if (bytes.size() >= sizeof count) std::memcpy(&count, bytes.data(), sizeof count);
    return count;
}

namespace {

/// Each corner stores its column and row in 16 bits each.
glsl::uint packed(glsl::ivec2 texel) {
    return static_cast<glsl::uint>(texel.x) | static_cast<glsl::uint>(texel.y) << 16;
}

void shift(glsl::SelfBorne& entry, glsl::uint by) {
    for (glsl::uint* const corner : {&entry.corners.x, &entry.corners.y, &entry.corners.z, &entry.corners.w})
        *corner += by;
}

}  // namespace

std::vector<std::vector<std::byte>> borne_by_member(const std::vector<glsl::SelfBorne>& list,
                                                    const SelfContact& contact) {
    std::vector<std::vector<glsl::SelfBorne>> lists(contact.member_count, std::vector<glsl::SelfBorne>(1));
    const std::size_t end = std::min<std::size_t>(list.size(), list.front().corners.x + std::size_t{1});
    for (std::size_t k = 1; k < end; ++k) {
        const glsl::uint corner = list[k].corners.x;
        const std::size_t member =
            contact.member_of({static_cast<int>(corner & 0xffffu), static_cast<int>(corner >> 16)});
        shift(lists[member].emplace_back(list[k]), 0u - packed(contact.corner_of(member)));
    }
    std::vector<std::vector<std::byte>> states;
    for (std::vector<glsl::SelfBorne>& each : lists) {
        each.front().corners.x = static_cast<glsl::uint>(each.size() - 1);
        states.push_back(borne_state(std::move(each)));
    }
    return states;
}

std::vector<glsl::SelfBorne> borne_of_all(const std::vector<std::vector<std::byte>>& states,
                                          const SelfContact& contact) {
    std::vector<glsl::SelfBorne> all(1);
    for (std::size_t member = 0; member < states.size(); ++member) {
        std::vector<glsl::SelfBorne> own(states[member].size() / sizeof(glsl::SelfBorne));
        std::memcpy(own.data(), states[member].data(), own.size() * sizeof(glsl::SelfBorne));
        for (std::size_t k = 1; k < own.size(); ++k) shift(all.emplace_back(own[k]), packed(contact.corner_of(member)));
    }
    all.front().corners.x = static_cast<glsl::uint>(all.size() - 1);
    return all;
}

bool is_borne_state(std::span<const std::byte> bytes, const SelfContact& contact) {
    if (bytes.size() != (borne_count(bytes) + std::size_t{1}) * sizeof(glsl::SelfBorne)) return false;
    std::vector<glsl::SelfBorne> list(bytes.size() / sizeof(glsl::SelfBorne));
    std::memcpy(list.data(), bytes.data(), bytes.size());
    const glsl::ivec2 grid = contact.push.grid;
    const auto lies_on_it = [&](glsl::uint corner) {
        return (corner & 0xffffu) < static_cast<glsl::uint>(grid.x) && corner >> 16 < static_cast<glsl::uint>(grid.y);
    };
    return std::ranges::all_of(std::span(list).subspan(1), [&](const glsl::SelfBorne& entry) {
        const glsl::uvec4& all = entry.corners;
        return lies_on_it(all.x) && lies_on_it(all.y) && lies_on_it(all.z) && lies_on_it(all.w);
    });
}

ContactCapacity limited(const ContactCapacity& capacity, std::uint64_t most_bytes) {
    const auto least = [most_bytes](std::uint32_t entries, ContactField list) {
        const std::uint64_t fitting = most_bytes / contact_fields()[static_cast<std::size_t>(list)].element.size;
        return static_cast<std::uint32_t>(std::min<std::uint64_t>({entries, fitting, most_contact_entries}));
    };
    return {least(capacity.pairs, ContactField::pairs), least(capacity.near, ContactField::near),
            least(capacity.cells, ContactField::cells), least(capacity.touching, ContactField::touching)};
}

}  // namespace drape
