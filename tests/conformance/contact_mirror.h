// The state of contact between cloths, on the device and in the twin, which has it in other containers.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "field_pair.h"
#include "graph/executor.h"
#include "solver/pass_kit.h"
#include "twin/twin.h"

namespace drape::test {

/// Returns what says that a particle was moved (self_pushed and those beside it), nothing where a number is none of it.
std::optional<std::uint32_t> mark_of(float w);

/// Returns whether a particle of which this share of its motion was `made` goes on, nothing where it cannot make such a
/// share.
std::optional<std::uint32_t> goes_on(float share, float made);

class ContactMirror {
  public:
    ContactMirror(const vulkan::Device& device, const SelfContact& contact, const graph::ResourcePool& pool)
        : device_(device), contact_(contact), pool_(pool) {
        for (const glsl::SelfCloth& cloth : contact.cloths)
            edge_ = std::max({edge_, double{cloth.spacing.x}, double{cloth.spacing.y}});
    }

    using Names = std::set<std::string, std::less<>>;
    /// Gives a step the twin's state, before the twin takes it: vectors, sums and shares by place, what touching pairs
    /// hold, and what pairs bore. The order of lists, the boxes and the tree stay the device's.
    void upload(const Step& step, const Names& used, const TwinContact& twin);
    /// Adds what a step wrote, and the twin as well. Where rounding turned whether a pair is listed, what follows at
    /// its corners in the substep is left out.
    void add_fields(const Step& step, const Names& written, const TwinContact& twin, std::vector<FieldPair>& fields);

  private:
    /// A pair of primitives: whether it is two edges, its corners.
    using PairKey = std::tuple<bool, std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>;
    static PairKey key_of(bool edges, const glsl::uvec4& all) { return {edges, all.x, all.y, all.z, all.w}; }
    static std::map<PairKey, glsl::SelfTouch> touching_of(const TwinContact& twin);
    static FieldPair membership(const char* name, const std::set<PairKey>& device, const std::set<PairKey>& twin);
    /// Keeps the pairs that one side alone has.
    void keep_turned(const std::set<PairKey>& device, const std::set<PairKey>& twin);
    /// Returns whether a place of this owner is to be compared after a step.
    bool concerns(const Step& step, const TwinContact& twin, std::size_t place) const;

    template <class T>
    std::vector<T> list(ContactField field) const;
    std::vector<glsl::vec4> image(ContactField field) const;
    void put(ContactField field, std::span<const std::byte> bytes) const;
    glsl::SelfRecord record() const { return list<glsl::SelfRecord>(ContactField::record).front(); }

    void upload_motions(ContactField field, const std::vector<glsl::vec4>& values) const;
    void upload_touching(const TwinContact& twin) const;
    void upload_sums(const TwinContact& twin) const;
    void upload_borne(const TwinContact& twin) const;
    void upload_shares(const Step& step, const TwinContact& twin);

    void add_places(const Step& step, ContactField field, const std::vector<glsl::vec4>& device,
                    const std::vector<glsl::vec4>& twin, const TwinContact& about,
                    std::vector<FieldPair>& fields) const;
    void add_before(const Step& step, const TwinContact& twin, std::vector<FieldPair>& fields) const;
    void add_led_ways(const Step& step, const TwinContact& twin, std::vector<FieldPair>& fields) const;
    void add_boxes(const TwinContact& twin, std::vector<FieldPair>& fields) const;
    void add_supports(const Step& step, const TwinContact& twin, std::vector<FieldPair>& fields) const;
    void add_pairs(const TwinContact& twin, std::vector<FieldPair>& fields);
    void add_touching(const TwinContact& twin, std::vector<FieldPair>& fields) const;
    void add_sums(const Step& step, const TwinContact& twin, std::vector<FieldPair>& fields) const;
    void add_shares(const Step& step, const TwinContact& twin, std::vector<FieldPair>& fields) const;
    void add_borne(const TwinContact& twin, std::vector<FieldPair>& fields) const;
    void add_crossings(const Step& step, const TwinContact& twin, std::vector<FieldPair>& fields) const;
    void add_record(const Step& step, const TwinContact& twin, std::vector<FieldPair>& fields) const;

    const vulkan::Device& device_;
    const SelfContact& contact_;
    const graph::ResourcePool& pool_;
    double edge_ = 0;                 ///< the longest of any cloth, m
    std::vector<float> shares_made_;  ///< in the rounds before this one
    std::set<PairKey> turned_;
    std::set<std::size_t> turned_places_;  ///< places of their corners
};

}  // namespace drape::test
