#include "simulation/member_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>
#include <stdexcept>

#include "base/byte_stream.h"
#include "cloth/contact_state.h"
#include "cloth/directions.h"
#include "cloth/texels.h"
#include "solver/state_transfer.h"

namespace drape {

namespace {

constexpr const char* loop_part = "loop";
constexpr std::string_view field_prefix = "field/";

std::string cuts_part(const ClothModel& cloth) { return "cuts/" + cloth.name; }
std::string borne_part() {
    return std::string(field_prefix) +
           resource_name(contact_fields()[static_cast<std::size_t>(ContactField::borne)], StateSet::run);
}

[[noreturn]] void refuse(const std::string& why) { throw Error("the saved state is not of this scene: " + why); }

/// Returns, by particle and direction (cloth/directions.h), the fraction of the spring's length where it was cut; -1:
/// it is not cut.
std::vector<std::byte> cut_bytes(const CutTopology& topology) {
    ByteWriter writer;
    const std::size_t count = topology.cloth().grid.particle_count();
    for (std::size_t particle = 0; particle < count; ++particle)
        for (std::size_t direction = 0; direction < spring_directions.size(); ++direction)
            writer(topology.cut_fraction(particle, direction));
    return writer.take();
}

template <class Visit>
void for_each_set(const SimulationModel& model, const Visit& visit) {
    for (std::size_t k = 0; k < state_set_count; ++k)
        if (const auto set = static_cast<StateSet>(k); has_set(model, set)) visit(set);
}

/// Calls `visit` with the cloth's number among all members' cloths and with the name of its field in a scene of its
/// own.
template <class Visit>
void for_each_field(const FrameGraphs& graphs, std::size_t member, StateSet set, const Visit& visit) {
    const std::size_t each = graphs.cloths_each();
    for (std::size_t cloth = 0; cloth < each; ++cloth)
        for (const FieldRow& row : cloth_fields())
            visit(cloth, row, std::string(field_prefix) + resource_name(graphs.member(member).cloths[cloth], row, set));
}

void save_shared(const FrameGraphs& graphs, std::size_t member, SimulationState& state) {
    std::vector<std::size_t> cloths(graphs.cloths_each());
    std::iota(cloths.begin(), cloths.end(), member * cloths.size());
    for_each_set(graphs.joint(), [&](StateSet set) {
        const std::vector<ClothBytes> fields = download_cloths(graphs.layout(), graphs.pool(), cloths, set);
        for_each_field(graphs, member, set, [&](std::size_t cloth, const FieldRow& row, const std::string& name) {
            if (auto bytes = field_of(fields[cloth], row.field); !bytes.empty()) state[name] = std::move(bytes);
        });
    });
    if (graphs.joint().self_contact)
        state[borne_part()] = download_borne(*graphs.joint().self_contact, graphs.pool())[member];
}

void save_single(const FrameGraphs& graphs, SimulationState& state) {
    const SimulationModel& model = graphs.joint();
    for (auto& [name, bytes] : download_state(graphs.layout(), graphs.pool()))
        state[std::string(field_prefix) + name] = std::move(bytes);
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth) {
        const CutTopology& topology = graphs.layout().topologies[cloth];
        if (model.scene.comes_apart() && topology.masked()) state[cuts_part(model.cloths[cloth])] = cut_bytes(topology);
    }
}

void restore_cuts(FrameGraphs& graphs, const SimulationState& state) {
    const SimulationModel& model = graphs.joint();
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth) {
        CutTopology& topology = graphs.layout().topologies[cloth];
        if (model.scene.comes_apart()) topology = CutTopology(topology.cloth());
        const auto part = state.find(cuts_part(model.cloths[cloth]));
        if (part == state.end()) continue;
        CutFindings findings;
        findings.fractions.resize(model.cloths[cloth].grid.particle_count());
        if (part->second.size() != findings.fractions.size() * sizeof(glsl::vec4)) refuse(part->first);
        std::memcpy(findings.fractions.data(), part->second.data(), part->second.size());
        topology.apply(findings);  // the order of the cuts changes neither what is cut nor how it splits
    }
}

void restore_single(FrameGraphs& graphs, const SimulationState& state) {
    restore_cuts(graphs, state);
    SimulationState fields;
    for (const auto& [name, bytes] : state)
        if (name.starts_with(field_prefix)) fields[name.substr(field_prefix.size())] = bytes;
    for (const auto& [name, bytes] : download_state(graphs.layout(), graphs.pool())) {
        const auto found = fields.find(name);
        if (found == fields.end() || !takes(graphs.layout(), name, bytes, found->second))
            refuse(fmt::format("field '{}'", name));
    }
    graphs.rebuild(fields);
}

/// Restores what members' contacts bore; empty bytes: nothing.
void put_borne(FrameGraphs& graphs, std::span<const std::size_t> members,
               const std::vector<std::vector<std::byte>>& own) {
    ClothLayout& layout = graphs.layout();
    std::vector<std::vector<std::byte>> all = download_borne(*layout.model.self_contact, graphs.pool());
    for (std::size_t i = 0; i < members.size(); ++i) all[members[i]] = own[i];
    if (upload_borne(layout, graphs.pool(), all)) return;
    graphs.rebuild(download_state(layout, graphs.pool()));
    if (!upload_borne(layout, graphs.pool(), all))
        throw vulkan::VulkanError("a buffer of the device has no room for what the members' contacts bore");
}

void restore_shared(FrameGraphs& graphs, std::span<const std::size_t> members,
                    std::span<const SimulationState> states) {
    const std::size_t each = graphs.cloths_each();
    const bool meets = graphs.joint().self_contact.has_value();
    std::vector<std::vector<std::byte>> borne;
    for (std::size_t i = 0; i < members.size() && meets; ++i) {
        const auto part = states[i].find(borne_part());
        if (part == states[i].end() || !is_borne_state(part->second, *graphs.member(members[i]).self_contact))
            refuse("what its contacts bore");
        borne.push_back(part->second);
    }
    for_each_set(graphs.joint(), [&](StateSet set) {
        std::vector<ClothBytes> fields(members.size() * each);
        std::map<std::size_t, const ClothBytes*> by_cloth;
        for (std::size_t i = 0; i < members.size(); ++i) {
            for_each_field(graphs, members[i], set,
                           [&](std::size_t cloth, const FieldRow& row, const std::string& name) {
                               if (const auto part = states[i].find(name); part != states[i].end())
                                   fields[i * each + cloth][std::string(row.name)] = part->second;
                           });
            for (std::size_t cloth = 0; cloth < each; ++cloth)
                by_cloth[members[i] * each + cloth] = &fields[i * each + cloth];
        }
        try {
            upload_cloths(graphs.layout(), graphs.pool(), by_cloth, set);
        } catch (const std::invalid_argument& wrong) {
            throw Error(wrong.what());
        }
    });
    if (meets) put_borne(graphs, members, borne);
}

}  // namespace

std::string field_part(const ClothModel& cloth, Field field) {
    return std::string(field_prefix) + resource_name(cloth, row_of(field));
}

SimulationState saved_state(const FrameServer& server, std::size_t member) {
    SimulationState state;
    if (server.size() == 1)
        save_single(server.graphs(), state);
    else
        save_shared(server.graphs(), member, state);
    ByteWriter writer;
    server.member(member).write(writer);
    state[loop_part] = writer.take();
    return state;
}

void restore_states(FrameServer& server, std::span<const std::size_t> members,
                    std::span<const SimulationState> states) {
    std::vector<std::unique_ptr<MemberRun>> runs;
    for (std::size_t i = 0; i < members.size(); ++i) {
        const auto loop = states[i].find(loop_part);
        if (loop == states[i].end()) refuse("it has no part 'loop'");
        runs.push_back(server.fresh_run(members[i]));
        ByteReader reader(loop->second);
        try {
            runs.back()->read(reader);
        } catch (const Error& error) {
            refuse(error.what());
        }
    }
    if (server.size() == 1 && !members.empty())
        restore_single(server.graphs(), states.front());
    else
        restore_shared(server.graphs(), members, states);
    for (std::size_t i = 0; i < members.size(); ++i) server.put_run(members[i], std::move(runs[i]));
}

void put_starts(FrameServer& server, std::span<const std::size_t> members) {
    FrameGraphs& graphs = server.graphs();
    const std::size_t each = graphs.cloths_each();
    std::map<std::size_t, const ClothBytes*> starts;
    for (const std::size_t member : members)
        for (std::size_t cloth = 0; cloth < each; ++cloth) starts[member * each + cloth] = nullptr;
    for_each_set(graphs.joint(), [&](StateSet set) { upload_cloths(graphs.layout(), graphs.pool(), starts, set); });
    if (graphs.joint().self_contact) put_borne(graphs, members, std::vector<std::vector<std::byte>>(members.size()));
}

}  // namespace drape
