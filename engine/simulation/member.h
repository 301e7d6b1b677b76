// A member of an ensemble: the model of its scene, which actions change (member_actions.h), and its last frame.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "control/watch.h"
#include "drape/ensemble.h"

namespace drape {

/// The numbers of a model that actions can change.
struct MemberMotion {
    explicit MemberMotion(const SimulationModel& model);
    void put_into(SimulationModel& model) const;

    /// Writes or reads them, by a ByteWriter or a ByteReader.
    template <class Archive>
    void transfer(Archive& archive) {
        archive(wind.velocity[0], wind.velocity[1], wind.velocity[2], wind.gust.amplitude);
        const auto transfer_vectors = [&](std::vector<VectorKey>& keys) {
            transfer_keys(archive, keys,
                          [&](VectorKey& key) { archive(key.time, key.value[0], key.value[1], key.value[2]); });
        };
        transfer_vectors(wind.keys);
        transfer_vectors(gravity);
        for (Load& load : loads) {
            archive(load.force[0], load.force[1], load.force[2]);
            transfer_vectors(load.force_keys);
            bool constant = load.pressure.has_value();
            double pressure = load.pressure.value_or(0);
            archive(constant, pressure);
            load.pressure = constant ? std::optional(pressure) : std::nullopt;
            transfer_keys(archive, load.pressure_keys, [&](NumberKey& key) { archive(key.time, key.value); });
        }
        for (DynamicPin& pin : pins) {
            transfer_path(archive, pin.path);
            transfer_path(archive, pin.let_go);
            bool released = pin.release.has_value();
            double release = pin.release.value_or(0);
            archive(released, release, pin.follows, pin.held.first[0], pin.held.first[1], pin.held.last[0],
                    pin.held.last[1]);
            pin.release = released ? std::optional(release) : std::nullopt;
        }
        for (MotionPath& path : colliders) transfer_path(archive, path);
        for (BodyActions& each : bodies) each.transfer(archive);
    }

    template <class Archive>
    static void transfer_path(Archive& archive, MotionPath& path) {
        transfer_keys(archive, path.keys, [&](MotionKey& key) {
            archive(key.time, key.translate[0], key.translate[1], key.translate[2], key.rotate[0], key.rotate[1],
                    key.rotate[2]);
        });
    }

    template <class Archive, class Key, class Transfer>
    static void transfer_keys(Archive& archive, std::vector<Key>& keys, const Transfer& transfer_key) {
        auto count = static_cast<std::uint64_t>(keys.size());
        archive(count);
        keys.resize(count < most_keys ? count : 0);
        for (Key& key : keys) transfer_key(key);
    }

    static constexpr std::uint64_t most_keys = 1'000'000;
    Wind wind;
    std::vector<VectorKey> gravity;
    std::vector<Load> loads;            ///< of all cloths
    std::vector<DynamicPin> pins;       ///< those pins of all cloths that can move, and the hands
    std::vector<MotionPath> colliders;  ///< sorted by kind
    std::vector<BodyActions> bodies;
};

/// What actions have moved so far.
struct Acted {
    bool pins = false, colliders = false;
};

/// What the host knows of a member's progress.
struct MemberProgress {
    std::uint32_t frame = 0;
    std::optional<FrameFailure> failure;
    bool judged = false;  ///< the statistics of the frame were judged
    std::vector<ClothStatistics> statistics;
    std::vector<BodyState> bodies;
    FrameEffort effort;
    std::optional<SelfContactReport> self_contact;
    Acted acted;
    std::unique_ptr<Watch> watch;  ///< of the member's model
};

struct Member : MemberProgress {
    /// `controls`: the pins and colliders that actions can move.
    Member(const SceneDescription& scene, const EnsembleControls& controls, const ModelOptions& options);
    Member(const Member&) = delete;
    Member& operator=(const Member&) = delete;

    SimulationModel model;
    MemberMotion start;  ///< before any action

    /// Resets the member to what it was before frame 0.
    void begin_anew();
    /// Judges the statistics of the member's current frame, once.
    void judge();
};

using Members = std::vector<std::unique_ptr<Member>>;

}  // namespace drape
