#include <condition_variable>
#include <exception>
#include <mutex>
#include <vector>

#include "drape/ensemble.h"

namespace drape {

struct EnsembleRun::Parts {
    explicit Parts(Ensemble given)
        : ensemble(std::move(given)), present(ensemble.size()), begun(present), gone(present) {
        take_arrays();
    }

    void take_arrays() {
        positions.clear();
        velocities.clear();
        for (std::size_t cloth = 0; cloth < ensemble.scene(0).cloths.size(); ++cloth) {
            positions.push_back(ensemble.positions(cloth));
            velocities.push_back(ensemble.velocities(cloth));
        }
    }

    /// Steps where all that are present wait. The lock is held.
    void step_if_all_wait() {
        if (waiting < present || present == 0) return;
        try {
            ensemble.step();
            take_arrays();
        } catch (...) {
            failed = std::current_exception();
        }
        waiting = 0;
        ++round;
        stepped.notify_all();
    }

    FinishedFrame frame(std::size_t member) {
        FinishedFrame frame;
        frame.frame = ensemble.frame(member);
        frame.statistics = ensemble.statistics(member);
        frame.effort = ensemble.effort(member);
        const auto of = [&](const MemberArray& array) {
            return std::span(array.data + member * array.member_stride, 4 * array.rows * array.columns);
        };
        for (const MemberArray& array : positions) frame.positions.push_back(of(array));
        for (const MemberArray& array : velocities) frame.velocities.push_back(of(array));
        return frame;
    }

    Ensemble ensemble;
    std::mutex mutex;
    std::condition_variable stepped;
    std::size_t waiting = 0, present;
    std::vector<bool> begun, gone;
    std::uint64_t round = 0;
    std::exception_ptr failed;
    std::vector<MemberArray> positions, velocities;  ///< by cloth
};

EnsembleRun::EnsembleRun(Ensemble ensemble) : parts_(std::make_unique<Parts>(std::move(ensemble))) {}
EnsembleRun::~EnsembleRun() = default;

FinishedFrame EnsembleRun::next(std::size_t member) {
    std::unique_lock lock(parts_->mutex);
    if (parts_->begun.at(member)) {
        const std::uint64_t round = parts_->round;
        ++parts_->waiting;
        parts_->step_if_all_wait();
        parts_->stepped.wait(lock, [&] { return parts_->round > round; });
    }
    parts_->begun[member] = true;
    if (parts_->failed) std::rethrow_exception(parts_->failed);
    return parts_->frame(member);
}

void EnsembleRun::leave(std::size_t member) {
    const std::scoped_lock lock(parts_->mutex);
    if (parts_->gone.at(member)) return;
    parts_->gone[member] = true;
    --parts_->present;
    parts_->step_if_all_wait();
}

}  // namespace drape
