#include "drape/ensemble.h"

#include <fmt/format.h>

#include <functional>
#include <map>

#include "base/byte_stream.h"
#include "cloth/members.h"
#include "cloth/statistics_transfer.h"
#include "picture/pictures.h"
#include "simulation/action_player.h"
#include "simulation/contact_report.h"
#include "simulation/device_parts.h"
#include "simulation/member_actions.h"
#include "simulation/member_frames.h"
#include "simulation/state_checksum.h"

namespace drape {

namespace {

constexpr const char *member_part = "member", *recording_part = "recording";

template <class Archive>
void transfer_body(Archive& archive, BodyState& body) {
    auto collider = static_cast<std::uint64_t>(body.collider);
    archive(collider, body.turn[0], body.turn[1], body.turn[2], body.turn[3], body.kinetic_energy,
            body.potential_energy);
    for (Vec3* const each :
         {&body.position, &body.velocity, &body.angular_velocity, &body.momentum, &body.angular_momentum})
        archive((*each)[0], (*each)[1], (*each)[2]);
    body.collider = static_cast<std::size_t>(collider);
}

/// Writes or reads what the host knows of a member, by a ByteWriter or a ByteReader. Returns false if that is
/// impossible.
template <class Archive>
bool transfer(Archive& archive, MemberProgress& member, MemberMotion& motion) {
    archive(member.frame, member.acted.pins, member.acted.colliders, member.judged);
    bool failed = member.failure.has_value();
    archive(failed);
    if (failed) {
        FrameFailure& failure = member.failure ? *member.failure : member.failure.emplace();
        auto kind = static_cast<std::uint8_t>(failure.kind);
        archive(kind, failure.reason, failure.frame, failure.criterion, failure.value, failure.bound, failure.cloth);
        failure.kind = static_cast<FrameFailure::Kind>(kind);
    } else {
        member.failure.reset();
    }
    motion.transfer(archive);
    if (member.self_contact) transfer_report(archive, *member.self_contact);
    for (ClothStatistics& statistics : member.statistics) transfer_statistics(archive, statistics);
    for (BodyState& body : member.bodies) transfer_body(archive, body);
    return member.watch->transfer(archive);
}

Members made(const std::vector<SceneDescription>& scenes, const EnsembleControls& controls, const ModelOptions& options,
             const std::function<void(Members&)>& check_two) {
    if (scenes.empty()) throw Error("an ensemble needs a member");
    Members members;
    for (std::size_t k = 0; k < scenes.size(); ++k) {
        if (scenes[k].actions)
            throw Error("an ensemble is told in its steps what to do, and the scene has actions of its own");
        if (const auto found = shape_difference(scenes.front(), scenes[k]))
            throw Error(fmt::format(
                "member {} is of another shape than member 0: {}; an ensemble's members share grids, pinned particles, "
                "kinds of colliders and the method (`drape sweep` runs any)",
                k, *found));
        members.push_back(std::make_unique<Member>(scenes[k], controls, options));
        if (members.size() == 2) check_two(members);
    }
    return members;
}

std::optional<std::string> obstacle_of(const Members& members) {
    for (const auto& member : members)
        if (auto found = sharing_obstacle(member->model)) return found;
    return std::nullopt;
}

}  // namespace

struct Ensemble::Parts {
    Parts(const std::vector<SceneDescription>& scenes, const EnsembleOptions& wanted, const Device& given)
        : device(given),
          options(wanted),
          members(made(scenes, wanted.controls, ModelOptions{.device = device_kind(given.info())},
                       [&](Members& two) {
                           if (drape::sharing_obstacle(two.front()->model)) return;
                           MemberFrames::check_room(given.parts_->device, two, scenes.size(), frame_options());
                       })),
          obstacle(obstacle_of(members)),
          recordings(wanted.record ? scenes.size() : 0) {
        frames = std::make_unique<MemberFrames>(given.parts_->device, members, frame_options(), !obstacle);
    }

    MemberFrameOptions frame_options() const { return {options.normals, options.kernels}; }
    void expect_fields() const {
        if (!members.front()->model.scene.force_fields)
            throw Error("no tensions and contact forces: the scenes do not say \"forces\": \"fields\"");
    }
    void check_numbers(std::span<const std::size_t> numbers) const {
        for (const std::size_t number : numbers)
            if (number >= members.size())
                throw Error(fmt::format("there is no member {}: they are 0 to {}", number, members.size() - 1));
    }

    Device device;
    EnsembleOptions options;
    Members members;
    std::optional<std::string> obstacle;
    std::unique_ptr<MemberFrames> frames;
    std::vector<std::vector<FrameActions>> recordings;  ///< by member; empty: nothing is recorded
    /// Pictures of the members that were drawn last, each with its images.
    std::map<std::size_t, std::unique_ptr<Pictures>> pictures;
    std::vector<std::uint8_t> picture;
};

Ensemble::Ensemble(const std::vector<SceneDescription>& members, const EnsembleOptions& options, const Device& device)
    : parts_(std::make_unique<Parts>(members, options, device)) {}
Ensemble::~Ensemble() = default;
Ensemble::Ensemble(Ensemble&&) noexcept = default;

std::size_t Ensemble::size() const { return parts_->members.size(); }
const SceneDescription& Ensemble::scene(std::size_t member) const { return parts_->members.at(member)->model.scene; }
const std::optional<std::string>& Ensemble::sharing_obstacle() const { return parts_->obstacle; }
std::size_t Ensemble::pass_count() const { return parts_->frames->pass_count(); }
double Ensemble::device_milliseconds() const { return parts_->frames->device_milliseconds(); }
std::uint32_t Ensemble::frame(std::size_t member) const { return parts_->members.at(member)->frame; }
const std::optional<FrameFailure>& Ensemble::failure(std::size_t member) const {
    parts_->members.at(member)->judge();
    return parts_->members[member]->failure;
}
const std::vector<ClothStatistics>& Ensemble::statistics(std::size_t member) const {
    return parts_->members.at(member)->statistics;
}

const std::vector<BodyState>& Ensemble::bodies(std::size_t member) const { return parts_->members.at(member)->bodies; }

const std::optional<SelfContactReport>& Ensemble::self_contact(std::size_t member) const {
    return parts_->members.at(member)->self_contact;
}

const FrameEffort& Ensemble::effort(std::size_t member) const { return parts_->members.at(member)->effort; }

void Ensemble::step(const EnsembleActions& actions) {
    Members& members = parts_->members;
    check_actions(actions, parts_->options.controls, members);
    for (std::size_t k = 0; k < members.size() && acts(parts_->options.controls); ++k) {
        if (!parts_->recordings.empty()) {
            FrameActions told = part_of(actions, k, members[k]->model, members[k]->frame + 1);
            if (is_any(told)) parts_->recordings[k].push_back(std::move(told));
        }
        act(actions, k, members[k]->frame, members[k]->model, members[k]->acted);
        parts_->frames->take_actions(k);
        if (is_any(actions)) parts_->frames->wake(k);
    }
    // Meanwhile the host judges the previous frame's statistics; what moves the cloths until the end of this frame is
    // known.
    parts_->frames->step([&] {
        for (const auto& member : members) {
            member->judge();
            member->watch->extend(member->frame + 1);
        }
    });
    for (const auto& member : members) member->judged = false;
    parts_->frames->refresh();
}

void Ensemble::reset(std::span<const std::size_t> members) {
    parts_->check_numbers(members);
    for (const std::size_t number : members) {
        parts_->members[number]->begin_anew();
        if (!parts_->recordings.empty()) parts_->recordings[number].clear();
        parts_->frames->take_actions(number);
    }
    parts_->frames->reset(members);
    parts_->frames->refresh();
}

MemberArray Ensemble::positions(std::size_t cloth) const { return parts_->frames->array(cloth, MemberValue::position); }
MemberArray Ensemble::velocities(std::size_t cloth) const {
    return parts_->frames->array(cloth, MemberValue::velocity);
}
MemberArray Ensemble::normals(std::size_t cloth) const {
    if (!parts_->options.normals) throw Error("no normals: the ensemble was made without");
    return parts_->frames->array(cloth, MemberValue::normal);
}

MemberArray Ensemble::tensions(std::size_t cloth) const {
    parts_->expect_fields();
    return parts_->frames->array(cloth, MemberValue::tension);
}
MemberArray Ensemble::contact_forces(std::size_t cloth) const {
    parts_->expect_fields();
    return parts_->frames->array(cloth, MemberValue::contact_force);
}

SimulationState Ensemble::save(std::size_t number) const {
    Member& member = *parts_->members.at(number);
    member.judge();
    SimulationState state = parts_->frames->save(number);
    ByteWriter writer;
    MemberMotion motion(member.model);
    transfer(writer, member, motion);  // when writing, transfer changes nothing
    state[member_part] = writer.take();
    if (!parts_->recordings.empty()) {
        ByteWriter recording;
        transfer_actions(recording, parts_->recordings[number]);
        state[recording_part] = recording.take();
    }
    seal(state);
    return state;
}

SceneActions Ensemble::recorded(std::size_t member) const {
    if (parts_->recordings.empty()) throw Error("nothing is recorded: the ensemble was made without");
    return {parts_->options.controls, parts_->recordings.at(member)};
}

void Ensemble::restore(std::span<const std::size_t> members, std::span<const SimulationState> states) {
    parts_->check_numbers(members);
    if (members.size() != states.size())
        throw Error(fmt::format("{} states for {} members", states.size(), members.size()));
    std::vector<MemberProgress> progress;
    std::vector<MemberMotion> motions;
    std::vector<std::vector<FrameActions>> recordings(members.size());
    for (std::size_t k = 0; k < members.size(); ++k) {
        const Member& member = *parts_->members[members[k]];
        expect_sealed(states[k]);
        const auto part = states[k].find(member_part);
        if (part == states[k].end()) throw Error("the saved state is not of an ensemble's member");
        progress.emplace_back().watch = std::make_unique<Watch>(member.model);
        progress.back().statistics.resize(member.model.cloths.size());
        progress.back().bodies.resize(body_count(member.model));
        progress.back().self_contact = starting_report(member.model);
        motions.emplace_back(member.model);
        ByteReader reader(part->second);
        if (!transfer(reader, progress.back(), motions.back()) || reader.left() > 0)
            throw Error("the saved state is not of this scene: its part 'member' is of something else");
        if (parts_->recordings.empty()) continue;
        const auto told = states[k].find(recording_part);
        if (told == states[k].end()) throw Error("the saved state is of an ensemble that records nothing");
        ByteReader recording(told->second);
        transfer_actions(recording, recordings[k]);
    }
    parts_->frames->restore(members, states);
    for (std::size_t k = 0; k < members.size(); ++k) {
        Member& member = *parts_->members[members[k]];
        static_cast<MemberProgress&>(member) = std::move(progress[k]);
        motions[k].put_into(member.model);
        if (!parts_->recordings.empty()) parts_->recordings[members[k]] = std::move(recordings[k]);
        parts_->frames->take_actions(members[k]);
    }
    parts_->frames->refresh();
}

std::span<const std::uint8_t> Ensemble::picture(std::size_t number) {
    constexpr std::size_t most_kept = 4;
    Member& member = *parts_->members.at(number);
    auto& all = parts_->pictures;
    // Pictures keep the paths that a member's pins and colliders had when they were made.
    const EnsembleControls& controls = parts_->options.controls;
    if (controls.pins || controls.colliders || (all.size() >= most_kept && !all.contains(number))) all.clear();
    std::unique_ptr<Pictures>& pictures = all[number];
    if (!pictures) {
        const ImageSettings& image = member.model.scene.image;
        PictureOptions options;
        options.width = image.size[0];
        options.height = image.size[1];
        options.samples = image.samples;
        options.view = parts_->options.view;
        pictures = std::make_unique<Pictures>(parts_->device.parts_->device, member.model, options);
    }
    FinishedFrame frame;
    frame.frame = member.frame;
    frame.bodies = member.bodies;
    std::vector<std::vector<float>> kept;
    for (std::size_t cloth = 0; cloth < member.model.cloths.size(); ++cloth) {
        const MemberArray all_of = positions(cloth);
        const float* const first = all_of.data + number * all_of.member_stride;
        kept.emplace_back(first, first + 4 * all_of.rows * all_of.columns);
    }
    for (const std::vector<float>& each : kept) frame.positions.emplace_back(each);
    const auto keep = [&](const FinishedFrame& drawn) { parts_->picture.assign(drawn.rgba.begin(), drawn.rgba.end()); };
    pictures->draw(frame, keep);
    pictures->flush(keep);
    return parts_->picture;
}

}  // namespace drape
