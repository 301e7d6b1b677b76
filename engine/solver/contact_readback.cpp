#include "solver/contact_readback.h"

#include <cstring>

#include "solver/readback_pass.h"

namespace drape {

namespace {

constexpr const char* contact_readback_name = "contact record on the host";

}  // namespace

void add_contact_readback(graph::Graph& graph, const ContactHandles& contact, const SelfContact& about) {
    const char* const name = "self record readback";
    add_buffer_readback(graph, {name, "simulate", name}, contact[ContactField::record], 0,
                        about.member_count * sizeof(glsl::SelfRecord), contact_readback_name);
}

glsl::SelfRecord self_record(const ClothLayout& layout, const graph::ResourcePool& pool, std::uint32_t slot) {
    glsl::SelfRecord record{};
    if (layout.model.self_contact)
        std::memcpy(&record, pool.buffer(contact_readback_name, slot).mapped().data(), sizeof record);
    return record;
}

glsl::SelfRecord self_record_of(const ClothLayout& layout, const graph::ResourcePool& pool, std::uint32_t slot,
                                std::size_t member) {
    if (layout.model.member_count == 1) return self_record(layout, pool, slot);
    glsl::SelfRecord record{};
    const auto records = pool.buffer(contact_readback_name, slot).mapped();
    std::memcpy(&record, records.subspan(member * sizeof record, sizeof record).data(), sizeof record);
    record.most_pairs = record.most_own_pairs;
    return record;
}

double self_list_use(const ClothLayout& layout, const glsl::SelfRecord& record) {
    return layout.model.self_contact ? self_list_use(layout.lists.capacity, record) : 0;
}

bool grow_lists(ContactLists& lists, const glsl::SelfRecord& record) {
    const ContactCapacity before = lists.capacity;
    lists.resize(grown_capacity(before, record));
    return lists.capacity != before;
}

}  // namespace drape
