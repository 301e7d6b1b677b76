#include "contact_mirror.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <tuple>

#include "cloth/texels.h"
#include "twin/kernels.h"

namespace drape::test {

using glsl::SelfTouch;
using glsl::vec4;

namespace {

const ContactRow& row_of(ContactField field) { return contact_fields()[static_cast<std::size_t>(field)]; }
std::string name_of(ContactField field) { return resource_name(row_of(field)); }

/// A list of the device has one kind of entry from its beginning and the other, edges, from its end.
template <class T, class Visit>
void for_both(std::vector<T>& list, std::uint32_t points, std::uint32_t edges, const Visit& visit) {
    for (std::size_t k = 0; k < points; ++k) visit(false, list[k]);
    for (std::size_t k = 0; k < edges; ++k) visit(true, list[list.size() - 1 - k]);
}

std::int64_t units_of(std::uint32_t low, std::uint32_t high, bool wide) {
    if (wide) return static_cast<std::int64_t>(std::uint64_t{high} << 32 | low);
    return std::int64_t{static_cast<std::int32_t>(low)} + std::int64_t{static_cast<std::int32_t>(high)} * (1 << 20);
}
std::array<std::uint32_t, 2> words_of(std::int64_t units, bool wide) {
    const auto bits = static_cast<std::uint64_t>(units);
    if (wide) return {static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bits >> 32)};
    return {static_cast<std::uint32_t>(bits & 0xfffffu), static_cast<std::uint32_t>(units >> 20)};
}

}  // namespace

std::optional<std::uint32_t> mark_of(float w) {
    for (const float mark : {0.0f, glsl::self_pushed, glsl::self_led_out, glsl::self_pushed_and_led})
        if (w == mark) return static_cast<std::uint32_t>(mark);
    return std::nullopt;
}

std::optional<std::uint32_t> goes_on(float share, float made) {
    if (!(share >= made && share <= 1.0f)) return std::nullopt;
    return share > made ? 1u : 0u;
}

bool ContactMirror::concerns(const Step& step, const TwinContact& twin, std::size_t place) const {
    const int owner = twin.owners[place];
    return owner >= 0 && (step.cloth == between_cloths || step.cloth == static_cast<std::size_t>(owner)) &&
           !turned_places_.contains(place);
}

std::map<ContactMirror::PairKey, SelfTouch> ContactMirror::touching_of(const TwinContact& twin) {
    std::map<PairKey, SelfTouch> all;
    for (const TwinTouch& each : twin.touching) all.emplace(key_of(each.edges, each.touch.corners), each.touch);
    return all;
}

/// Returns for every pair of either set whether each of them has it.
FieldPair ContactMirror::membership(const char* name, const std::set<PairKey>& device, const std::set<PairKey>& twin) {
    std::set<PairKey> all = device;
    all.insert(twin.begin(), twin.end());
    FieldPair pair{.name = name};
    for (const PairKey& key : all) {
        pair.device_integers.push_back(device.contains(key));
        pair.twin_integers.push_back(twin.contains(key));
    }
    return pair;
}

void ContactMirror::keep_turned(const std::set<PairKey>& device, const std::set<PairKey>& twin) {
    std::vector<PairKey> apart;
    std::ranges::set_symmetric_difference(device, twin, std::back_inserter(apart));
    for (const PairKey& key : apart) {
        turned_.insert(key);
        const auto& [edges, a, b, c, d] = key;
        for (const std::uint32_t corner : {a, b, c, d})
            turned_places_.insert((corner >> 16) * static_cast<std::size_t>(contact_.push.grid.x) + (corner & 0xffffu));
    }
}

template <class T>
std::vector<T> ContactMirror::list(ContactField field) const {
    const vulkan::Buffer& buffer = pool_.buffer(name_of(field));
    std::vector<T> values(buffer.description().byte_count / sizeof(T));
    vulkan::download(device_, buffer, std::as_writable_bytes(std::span(values)));
    return values;
}

std::vector<vec4> ContactMirror::image(ContactField field) const {
    std::vector<vec4> values(contact_.place_count());
    vulkan::download(device_, pool_.image(name_of(field)), std::as_writable_bytes(std::span(values)));
    return values;
}

void ContactMirror::put(ContactField field, std::span<const std::byte> bytes) const {
    vulkan::upload_range(device_, pool_.buffer(name_of(field)), 0, bytes);
}

void ContactMirror::upload(const Step& step, const Names& used, const TwinContact& twin) {
    const auto uses = [&](ContactField field) { return used.contains(name_of(field)); };
    if (step.kind == StepKind::self_boxes) upload_borne(twin);
    for (const auto& [field, values] : {std::pair{ContactField::displacements, &twin.displacements},
                                        {ContactField::last_motions, &twin.last_motions}})
        if (uses(field) && step.kind != StepKind::self_gather) upload_motions(field, *values);
    for (const auto& [field, values] : {std::pair{ContactField::before, &twin.before},
                                        {ContactField::velocities, &twin.velocities},
                                        {ContactField::made_good, &twin.made_good},
                                        {ContactField::led_ways, &twin.led_ways}})
        if (uses(field) && !values->empty()) put(field, std::as_bytes(std::span(*values)));
    if (uses(ContactField::crossings) && step.kind == StepKind::self_apart)
        put(ContactField::crossings, std::as_bytes(std::span(twin.crossings)));
    if (uses(ContactField::touching) && step.kind == StepKind::self_contact) upload_touching(twin);
    if (uses(ContactField::sums) && (step.kind == StepKind::self_contact || step.kind == StepKind::self_push ||
                                     step.kind == StepKind::self_couples))
        upload_sums(twin);
    if (step.kind == StepKind::self_limit || step.kind == StepKind::self_return) upload_shares(step, twin);
}

/// A round begins with the shares of the one before it, and the step that ends contact takes those of the last one.
void ContactMirror::upload_shares(const Step& step, const TwinContact& twin) {
    const int round = step.kind == StepKind::self_limit ? step.push<glsl::SelfContactPush>().round : glsl::self_rounds;
    shares_made_.assign(contact_.place_count(), 0);
    if (round == 0) return;
    shares_made_ = twin.shares;
    const auto bytes = std::as_bytes(std::span(twin.shares));
    vulkan::upload_range(device_, pool_.buffer(name_of(ContactField::shares)),
                         static_cast<std::size_t>(round - 1) * bytes.size(), bytes);
    auto of_cloths = list<std::uint32_t>(ContactField::cloth_shares);
    for (std::size_t cloth = 0; cloth < twin.cloth_shares.size(); ++cloth) {
        const auto& [whole, least] = twin.cloth_shares[cloth];
        const std::size_t first = cloth * glsl::self_cloth_words;
        of_cloths[first] = whole ? 1 : 0;
        of_cloths[first + static_cast<std::size_t>(round)] = glsl::floatBitsToUint(least);
    }
    put(ContactField::cloth_shares, std::as_bytes(std::span(of_cloths)));
}

void ContactMirror::upload_motions(ContactField field, const std::vector<vec4>& values) const {
    std::vector<vec4> all = image(field);
    for (std::size_t place = 0; place < all.size(); ++place) all[place] = texel(xyz(values[place]), all[place].w);
    vulkan::upload(device_, pool_.image(name_of(field)), std::as_bytes(std::span(all)));
}

void ContactMirror::upload_touching(const TwinContact& twin) const {
    const std::map<PairKey, SelfTouch> theirs = touching_of(twin);
    std::vector<SelfTouch> all = list<SelfTouch>(ContactField::touching);
    const glsl::SelfRecord counts = record();
    for_both(all, counts.touching_point_count, counts.touching_edge_count, [&](bool edges, SelfTouch& touch) {
        const auto found = theirs.find(key_of(edges, touch.corners));
        if (found != theirs.end()) touch = found->second;
    });
    put(ContactField::touching, std::as_bytes(std::span(all)));
}

void ContactMirror::upload_sums(const TwinContact& twin) const {
    const bool wide = device_.capabilities().wide_atomics;
    std::vector<glsl::SelfSum> all(contact_.place_count() * glsl::self_sum_count);
    for (std::size_t which = 0; which < glsl::self_sum_count; ++which)
        for (std::size_t place = 0; place < contact_.place_count(); ++place) {
            const auto& units = twin.sums[place].units[which];
            const auto x = words_of(units[0], wide), y = words_of(units[1], wide), z = words_of(units[2], wide);
            // Every place counts as touched, so that the next substep clears what is uploaded here.
            all[which * contact_.place_count() + place] = {{x[0], x[1], y[0], y[1]},
                                                           {z[0], z[1], which == 0 ? twin.sums[place].weight : 0, 1}};
        }
    put(ContactField::sums, std::as_bytes(std::span(all)));
}

void ContactMirror::upload_borne(const TwinContact& twin) const {
    std::vector<glsl::SelfBorne> all{{{static_cast<std::uint32_t>(twin.borne.size()), 0, 0, 0}, {}}};
    for (const auto& [key, force] : twin.borne)
        all.push_back(
            {{key[0], key[1], key[2], key[3]},
             {glsl::floatBitsToUint(force.x), glsl::floatBitsToUint(force.y), glsl::floatBitsToUint(force.z), key[4]}});
    put(ContactField::borne, std::as_bytes(std::span(all)));
}

void ContactMirror::add_fields(const Step& step, const Names& written, const TwinContact& twin,
                               std::vector<FieldPair>& fields) {
    if (step.kind == StepKind::self_gather) turned_.clear(), turned_places_.clear();
    const auto wrote = [&](ContactField field) { return written.contains(name_of(field)); };
    const bool touches = !twin.touching.empty();
    if (wrote(ContactField::positions))
        add_places(step, ContactField::positions, image(ContactField::positions), twin.positions, twin, fields);
    if (wrote(ContactField::displacements))
        add_places(step, ContactField::displacements, image(ContactField::displacements), twin.displacements, twin,
                   fields);
    if (wrote(ContactField::last_motions))
        add_places(step, ContactField::last_motions, image(ContactField::last_motions), twin.last_motions, twin,
                   fields);
    if (wrote(ContactField::supports)) add_supports(step, twin, fields);
    if (wrote(ContactField::boxes) && step.kind == StepKind::self_boxes) add_boxes(twin, fields);
    if (wrote(ContactField::before)) add_before(step, twin, fields);
    if (wrote(ContactField::velocities))
        add_places(step, ContactField::velocities, list<vec4>(ContactField::velocities), twin.velocities, twin, fields);
    if (wrote(ContactField::made_good))
        add_places(step, ContactField::made_good, list<vec4>(ContactField::made_good), twin.made_good, twin, fields);
    if (wrote(ContactField::led_ways)) add_led_ways(step, twin, fields);
    if (step.kind == StepKind::self_pairs) add_pairs(twin, fields);
    if (wrote(ContactField::touching) && step.kind != StepKind::self_pairs) add_touching(twin, fields);
    if (wrote(ContactField::sums) && step.kind != StepKind::self_primitives && touches) add_sums(step, twin, fields);
    if (step.kind == StepKind::self_limit) add_shares(step, twin, fields);
    if (step.kind == StepKind::self_contact && step.push<glsl::SelfContactPush>().round == glsl::self_iterations - 1)
        add_borne(twin, fields);
    if (step.kind == StepKind::self_crossings || step.kind == StepKind::self_apart) add_crossings(step, twin, fields);
    if (wrote(ContactField::record)) add_record(step, twin, fields);
}

void ContactMirror::add_places(const Step& step, ContactField field, const std::vector<vec4>& device,
                               const std::vector<vec4>& twin, const TwinContact& about,
                               std::vector<FieldPair>& fields) const {
    TexelPairs texels("contact " + std::string(row_of(field).name), edge_);
    // Places that contact did not move have values left over from earlier substeps.
    const bool of_moved = field == ContactField::velocities || field == ContactField::made_good;
    for (std::size_t place = 0; place < twin.size(); ++place) {
        if (!concerns(step, about, place) || (of_moved && about.before[place].w == 0.0f)) continue;
        if (field == ContactField::displacements)  // the device has more bits in w
            texels.add(xyz(device[place]), xyz(twin[place]));
        else
            texels.add(device[place], twin[place]);
    }
    texels.put_into(fields);
}

void ContactMirror::add_before(const Step& step, const TwinContact& twin, std::vector<FieldPair>& fields) const {
    TexelPairs motions("contact before", edge_);
    DecidedPairs marks("contact before.w");
    const auto before = list<vec4>(ContactField::before);
    for (std::size_t place = 0; place < before.size(); ++place) {
        if (!concerns(step, twin, place)) continue;
        const vec4 &ours = before[place], &theirs = twin.before[place];
        motions.add(xyz(ours), xyz(theirs));
        marks.add(mark_of(ours.w), mark_of(theirs.w).value(), ours.w, theirs.w);
    }
    motions.put_into(fields);
    marks.put_into(fields);
}

/// Places that no collider led out of an overlap, on either side, have values left over from earlier substeps.
void ContactMirror::add_led_ways(const Step& step, const TwinContact& twin, std::vector<FieldPair>& fields) const {
    TexelPairs ways("contact led_ways", edge_);
    const auto before = list<vec4>(ContactField::before), led_ways = list<vec4>(ContactField::led_ways);
    for (std::size_t place = 0; place < before.size(); ++place)
        if (concerns(step, twin, place) && std::min(before[place].w, twin.before[place].w) >= glsl::self_led_out)
            ways.add(led_ways[place], twin.led_ways[place]);
    ways.put_into(fields);
}

void ContactMirror::add_boxes(const TwinContact& twin, std::vector<FieldPair>& fields) const {
    TexelPairs texels("contact boxes");
    const auto boxes = list<glsl::SelfBox>(ContactField::boxes);
    for (std::size_t place = 0; place < twin.boxes.size(); ++place) {
        if (twin.owners[place] < 0) continue;
        texels.add(xyz(boxes[place].lower), xyz(twin.boxes[place].lower));
        texels.add(xyz(boxes[place].upper), xyz(twin.boxes[place].upper));
    }
    texels.put_into(fields);
}

void ContactMirror::add_supports(const Step& step, const TwinContact& twin, std::vector<FieldPair>& fields) const {
    TexelPairs planes("contact supports", 0, edge_), grips("contact grips", edge_);
    const auto supports = list<vec4>(ContactField::supports);
    for (std::size_t place = 0; place < twin.supports.size(); ++place) {
        if (!concerns(step, twin, place)) continue;
        planes.add(supports[2 * place], twin.supports[place].plane);
        grips.add(supports[2 * place + 1], twin.supports[place].grip);
    }
    planes.put_into(fields);
    grips.put_into(fields);
}

void ContactMirror::add_pairs(const TwinContact& twin, std::vector<FieldPair>& fields) {
    std::set<PairKey> theirs, ours, theirs_touching, ours_touching;
    for (const TwinPair& pair : twin.pairs) theirs.insert(key_of(pair.edges, pair.corners));
    for (const TwinTouch& each : twin.touching) theirs_touching.insert(key_of(each.edges, each.touch.corners));
    const glsl::SelfRecord counts = record();
    auto pairs = list<glsl::uvec4>(ContactField::pairs);
    for_both(pairs, counts.point_count, counts.edge_count,
             [&](bool edges, const glsl::uvec4& all) { ours.insert(key_of(edges, all)); });
    auto touching = list<SelfTouch>(ContactField::touching);
    for_both(touching, counts.touching_point_count, counts.touching_edge_count,
             [&](bool edges, const SelfTouch& touch) { ours_touching.insert(key_of(edges, touch.corners)); });
    fields.push_back(membership("contact pairs", ours, theirs));
    fields.push_back(membership("contact touching pairs", ours_touching, theirs_touching));
    keep_turned(ours, theirs);
    keep_turned(ours_touching, theirs_touching);
}

void ContactMirror::add_touching(const TwinContact& twin, std::vector<FieldPair>& fields) const {
    const std::map<PairKey, SelfTouch> theirs = touching_of(twin);
    std::vector<SelfTouch> all = list<SelfTouch>(ContactField::touching);
    const glsl::SelfRecord counts = record();
    FieldPair weights{.name = "contact weights", .least_scale = 1};
    TexelPairs normals("contact normals", 1, edge_), impulses("contact impulses", edge_);
    for_both(all, counts.touching_point_count, counts.touching_edge_count, [&](bool edges, const SelfTouch& touch) {
        const auto found = theirs.find(key_of(edges, touch.corners));
        if (found == theirs.end()) return;
        const SelfTouch& other = found->second;
        for (std::size_t k = 0; k < 4; ++k) {
            weights.device.push_back(component(touch.weights, k));
            weights.twin.push_back(component(other.weights, k));
        }
        normals.add(touch.normal, other.normal);
        impulses.add(touch.impulse, other.impulse);
    });
    fields.push_back(weights);
    normals.put_into(fields);
    impulses.put_into(fields);
}

void ContactMirror::add_sums(const Step& step, const TwinContact& twin, std::vector<FieldPair>& fields) const {
    const bool wide = device_.capabilities().wide_atomics;
    const auto all = list<glsl::SelfSum>(ContactField::sums);
    FieldPair units{.name = "contact sums",
                    .least_scale = edge_ * glsl::self_units_per_impulse(contact_.push.thickness)};
    FieldPair weights{.name = "contact sums of weights"};
    for (std::size_t place = 0; place < twin.sums.size(); ++place) {
        if (!concerns(step, twin, place)) continue;
        for (std::size_t which = 0; which < glsl::self_sum_count; ++which) {
            const glsl::SelfSum& sum = all[which * twin.sums.size() + place];
            const std::int64_t values[] = {units_of(sum.xy.x, sum.xy.y, wide), units_of(sum.xy.z, sum.xy.w, wide),
                                           units_of(sum.z_weight.x, sum.z_weight.y, wide)};
            for (std::size_t k = 0; k < 3; ++k) {
                units.device.push_back(static_cast<float>(values[k]));
                units.twin.push_back(static_cast<float>(twin.sums[place].units[which][k]));
            }
        }
        weights.device.push_back(static_cast<float>(all[place].z_weight.z));
        weights.twin.push_back(static_cast<float>(twin.sums[place].weight));
    }
    fields.push_back(units);
    fields.push_back(weights);
}

void ContactMirror::add_shares(const Step& step, const TwinContact& twin, std::vector<FieldPair>& fields) const {
    const int round = step.push<glsl::SelfContactPush>().round;
    const auto shares = list<float>(ContactField::shares);
    DecidedPairs decided("contact shares", 1);
    for (std::size_t place = 0; place < twin.shares.size(); ++place) {
        if (!concerns(step, twin, place)) continue;
        const float ours = shares[static_cast<std::size_t>(round) * contact_.place_count() + place],
                    theirs = twin.shares[place], made = shares_made_[place];
        decided.add(goes_on(ours, made), goes_on(theirs, made).value(), ours, theirs);
    }
    decided.put_into(fields);
}

void ContactMirror::add_borne(const TwinContact& twin, std::vector<FieldPair>& fields) const {
    const auto all = list<glsl::SelfBorne>(ContactField::borne);
    const double step = contact_.push.step;
    TexelPairs forces("contact borne", edge_ / (step * step));
    std::set<PairKey> ours, theirs;
    const auto add_known = [this](std::set<PairKey>& pairs, const PairKey& key) {
        if (!turned_.contains(key)) pairs.insert(key);
    };
    for (const auto& [key, force] : twin.borne) add_known(theirs, {key[4] != 0, key[0], key[1], key[2], key[3]});
    for (std::size_t k = 1; k <= all.front().corners.x; ++k) {
        const glsl::uvec4 &corners = all[k].corners, &force = all[k].force;
        add_known(ours, key_of((force.w & 1u) != 0, corners));
        const auto found = twin.borne.find({corners.x, corners.y, corners.z, corners.w, force.w & 1u});
        if (found == twin.borne.end()) continue;
        forces.add(
            glsl::vec3{std::bit_cast<float>(force.x), std::bit_cast<float>(force.y), std::bit_cast<float>(force.z)},
            found->second);
    }
    forces.put_into(fields);
    fields.push_back(membership("contact borne pairs", ours, theirs));
}

void ContactMirror::add_crossings(const Step& step, const TwinContact& twin, std::vector<FieldPair>& fields) const {
    if (!twin.crossings.empty()) {
        const auto all = list<glsl::SelfCrossings>(ContactField::crossings);
        FieldPair counts{.name = "contact crossings"}, sums{.name = "contact crossing sums"};
        for (std::size_t k = 0; k < twin.crossings.size(); ++k) {
            counts.device_integers.push_back(static_cast<std::uint32_t>(all[k].count));
            counts.twin_integers.push_back(static_cast<std::uint32_t>(twin.crossings[k].count));
            // Each pair's share is rounded to an integer, which may be one off: 8 units for all of them.
            sums.least_scale = std::max(sums.least_scale, 0x1p23 / 8 * twin.crossings[k].count);
            sums.device.push_back(static_cast<float>(all[k].sum));
            sums.twin.push_back(static_cast<float>(twin.crossings[k].sum));
        }
        fields.push_back(counts);
        fields.push_back(sums);
    }
    if (twin.led.empty() || step.kind != StepKind::self_apart) return;
    const auto led = list<vec4>(ContactField::led);
    TexelPairs pairs("contact led", edge_);
    for (std::size_t cloth = 0; cloth < twin.led.size(); ++cloth) pairs.add(xyz(led[cloth]), twin.led[cloth]);
    pairs.put_into(fields);
}

void ContactMirror::add_record(const Step& step, const TwinContact& twin, std::vector<FieldPair>& fields) const {
    const glsl::SelfRecord ours = record(), &theirs = twin.record;
    if (step.kind == StepKind::self_gather && step.push<glsl::SelfClothPush>().cloth_count > 0) {
        TexelPairs carried("contact carried", edge_);
        carried.add(xyz(ours.carried), xyz(theirs.carried));
        carried.put_into(fields);
    }
    if (step.kind == StepKind::self_return && turned_.empty()) {
        fields.push_back(
            {"contact record", {}, {}, {ours.unproved, ours.truncated}, {theirs.unproved, theirs.truncated}});
        fields.push_back({"contact lag",
                          {std::bit_cast<float>(ours.most_lag)},
                          {std::bit_cast<float>(theirs.most_lag)},
                          {},
                          {},
                          edge_});
    }
}

}  // namespace drape::test
