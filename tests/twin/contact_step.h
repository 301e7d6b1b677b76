// The passes of contact between cloths, as the twin takes them. It finds pairs by trying all boxes against all others,
// so it shows any pair that the device's tree misses.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "cloth/texels.h"
#include "twin/kernels.h"
#include "twin/twin.h"

namespace drape {

using namespace glsl;

/// A step of contact: each function is a pass over the sheet.
class ContactStep {
  public:
    ContactStep(TwinContact& contact, const SelfContactPush& push, bool looks_back = false, bool ends_frame = false)
        : contact_(contact), model_(*contact.model), push_(push), looks_back_(looks_back), ends_frame_(ends_frame) {}

    void boxes();
    void crossings();
    void apart();
    void pairs();
    void contact();
    void push();
    void limit();
    void sew_surfaces();
    void sew_motions();
    void count_lists();
    void cut_short(std::size_t cloth);

  private:
    uint place(ivec2 texel) const { return static_cast<uint>(texel.y * push_.grid.x + texel.x); }
    uint place(uint corner) const { return place(self_texel(corner)); }
    ivec2 texel_of(std::size_t place) const {
        return {static_cast<int>(place) % push_.grid.x, static_cast<int>(place) / push_.grid.x};
    }
    bool owned(std::size_t place) const { return contact_.owners[place] >= 0; }
    const SelfCloth& cloth_at(std::size_t place) const {
        return model_.cloths[static_cast<std::size_t>(contact_.owners[place])];
    }
    const SelfCloth& cloth_of(uint corner) const { return cloth_at(place(corner)); }
    uint meeting(std::size_t one, std::size_t other) const {
        const auto a = static_cast<std::size_t>(contact_.owners[one]),
                   b = static_cast<std::size_t>(contact_.owners[other]);
        return model_.meetings[a * model_.cloths.size() + b];
    }
    bool meet(std::size_t one, std::size_t other) const { return meeting(one, other) != self_meets_not; }
    bool still_cross(std::size_t one, std::size_t other) const {
        const uint meets = meeting(one, other);
        return meets >= self_meets_apart && contact_.crossings[meets - self_meets_apart].count > 0;
    }
    bool boxes_meet(std::size_t a, std::size_t b) const {
        return self_boxes_meet(contact_.boxes[a], contact_.boxes[b], push_,
                               self_mean_thickness(cloth_at(a), cloth_at(b)));
    }
    /// The place at which what contact does to a particle is summed.
    uint leader(std::size_t place) const {
        return model_.is_sewn() ? static_cast<uint>(model_.sewn[place].leader) : static_cast<uint>(place);
    }
    /// The first of the cloths that are sewn to the one at a place.
    std::size_t body_at(std::size_t place) const { return static_cast<std::size_t>(cloth_at(place).body); }
    bool is_sewn(std::size_t place) const { return model_.is_sewn() && model_.sewn[place].inverse_mass > 0.0f; }
    float own_thickness(std::size_t place) const {
        return model_.is_sewn() ? model_.sewn[place].thickness : cloth_at(place).thickness;
    }
    /// Calls for a leader's place and for those of all that follow it.
    template <class Visit>
    void for_sewn(std::size_t leader, const Visit& visit) const {
        visit(leader);
        for (int next = model_.is_sewn() ? model_.sewn[leader].next : -1; next >= 0;
             next = model_.sewn[static_cast<std::size_t>(next)].next)
            visit(static_cast<std::size_t>(next));
    }
    float led_by_colliders(std::size_t place) const;
    SelfCell cell(std::size_t place) const;
    bool inside(const SelfCloth& cloth, ivec2 texel) const {
        return texel.x - cloth.first.x < cloth.grid.x && texel.y - cloth.first.y < cloth.grid.y;
    }
    vec3 position(uint place) const { return xyz(contact_.positions[place]); }
    vec3 displacement(uint place) const { return xyz(contact_.displacements[place]); }
    float inverse_mass(uint place) const { return contact_.positions[place].w; }
    bool held(uint place) const { return !(inverse_mass(place) > 0.0f); }
    /// The motion that impulses of this step change.
    vec3 changed(uint place) const {
        return xyz(looks_back_ ? contact_.last_motions[place] : contact_.displacements[place]);
    }
    bool begins_with_none() const { return looks_back_ && push_.round == 0; }
    vec3 motion(uint place) const { return self_relative_motion(displacement(place), xyz(contact_.record.carried)); }
    vec3 bounded(uint place) const {
        vec3 moved = displacement(place);
        if (!held(place))
            moved =
                self_bounded(moved, xyz(contact_.before[place]), xyz(contact_.record.carried), own_thickness(place));
        return self_relative_motion(moved, xyz(contact_.record.carried));
    }
    template <class Of>
    SelfCorners corners(const TwinPair& pair, const Of& of) const {
        const uvec4& all = pair.corners;
        return {of(place(all.x)), of(place(all.y)), of(place(all.z)), of(place(all.w))};
    }
    std::array<uint, 4> places(const TwinPair& pair) const {
        const uvec4& all = pair.corners;
        return {place(all.x), place(all.y), place(all.z), place(all.w)};
    }
    SelfCorners positions(const TwinPair& pair) const {
        return corners(pair, [this](uint place) { return position(place); });
    }
    /// Returns the thickness that a pair keeps, m, and its friction.
    vec2 skin(const TwinPair& pair, vec4 weights) const {
        const uvec4& all = pair.corners;
        const SelfCloth &one = cloth_of(all.x), &other = cloth_of(all.w);
        vec2 both{self_mean_thickness(one, other), self_pair_friction(one, other)};
        if (!model_.skins.empty()) {
            const auto [a, b, c, d] = places(pair);
            const vec2 skins[] = {model_.skins[a], model_.skins[b], model_.skins[c], model_.skins[d]};
            both = {self_thickness_there(weights, {skins[0].x, skins[1].x, skins[2].x, skins[3].x}),
                    self_friction_there(pair.edges, weights, {skins[0].y, skins[1].y, skins[2].y, skins[3].y})};
        }
        const float kept = self_pair_thickness(both.x, one, other, pair.edges, self_texel(all.x), self_texel(all.y),
                                               self_texel(all.z), self_texel(all.w));
        const bool at_seam = std::ranges::any_of(places(pair), [this](uint at) { return is_sewn(at); });
        return {at_seam ? self_thickness_at_seam(kept, one, other) : kept, both.y};
    }
    SelfBox point_box(uint place) const { return self_point_box(position(place), motion(place)); }
    SelfBox slab(uint corner, vec3 axis) const {
        return self_slab(position(place(corner)), motion(place(corner)), axis);
    }
    template <class... Corners>
    SelfBox slab(vec3 axis, uint first, Corners... others) const {
        SelfBox box = slab(first, axis);
        for (const uint corner : {others...}) box = self_slabs_joined(box, slab(corner, axis));
        return box;
    }
    vec3 cell_normal(ivec2 own) const;
    SelfBox cell_box(ivec2 own) const;
    bool lies_flat(ivec2 cell) const;
    void add_between(ivec2 a, ivec2 b);
    bool triangle_exists(ivec2 cell, int which) const;
    bool edge_exists(ivec2 particle, int k) const;
    bool is_corner(ivec2 particle) const;  ///< of a triangle that exists
    void add_triangles(ivec2 particle, ivec2 cell, vec3 axis);
    void add_pair(const TwinPair& pair, vec3 axis);
    void touch(const TwinPair& pair, const SelfGap& gap, float friction, float kept);
    void leave_behind(uint place, float share);
    void share_in_cloths();
    /// Returns the share of its motion that a particle makes after the last round.
    float made_by(uint place) const {
        const auto& [whole, least] = contact_.cloth_shares[body_at(place)];
        return push_.round > 0 && whole && !held(place) ? least : contact_.shares[leader(place)];
    }
    void add_parts(std::size_t which, uint corner, const SelfParts& parts);
    void add_couple(const TwinPair& pair, vec4 weights, vec3 impulse);
    void add_impulse(std::size_t round, bool edges, const uvec4& all, vec4 weights, vec3 impulse);
    vec3 impulse_at(std::size_t round, uint place) const;
    vec3 motion_in_round(uint place, float mass) const;
    void work(TwinTouch& pair);
    float mass_of(uint corner, const SelfCloth& cloth) const { return inverse_mass(place(corner)) * cloth.lightness; }
    void clear_rounds(std::size_t place) {
        for (std::size_t round = 1; round <= self_iterations; ++round) contact_.sums[place].units[round] = {};
    }
    void move_to(std::size_t place, vec3 displacement) {
        contact_.displacements[place] = texel(displacement, contact_.displacements[place].w);
        contact_.before[place].w = self_pushed;
    }

    TwinContact& contact_;
    const SelfContact& model_;
    const SelfContactPush& push_;
    bool looks_back_, ends_frame_;
};

}  // namespace drape
