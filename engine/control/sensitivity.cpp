#include "control/sensitivity.h"

#include <algorithm>
#include <cmath>

namespace drape {

namespace {

/// The disturbed run begins when the estimated error is this share of the allowed one; there the substep control begins
/// to react to it.
constexpr double matters = 0.7;
/// Runs that began a millionth apart, and have diverged by this share of the estimated error, are a good part of it.
constexpr double good_share = 0.5;
/// The disturbed run ends where within `patience` (s) it has not diverged by `growth` times as much.
constexpr double patience = 1, growth = 3;
/// s until a disturbed run may begin again.
constexpr double pause = 2;
/// s for which runs must be as far apart as the error until the companion tells nothing more.
constexpr double lasting = 0.5;

}  // namespace

bool Sensitivity::begins(std::uint32_t frame, const MotionError& error, bool predictable) const {
    if (runs_ || sensitive_ || (predictable && !(error.share() > matters))) return false;
    return ended_ == 0 || seconds(frame - ended_) > pause;
}

void Sensitivity::begin(std::uint32_t frame) {
    runs_ = true;
    parted_ = 0;
    seen_ = covered_ = frame;
    mark_ = {frame, 0};
}

void Sensitivity::saw(std::uint32_t frame, std::span<const double> distances, const MotionError& error) {
    const double kept = parted_ * std::exp(-seconds(frame - seen_) / motion_error_hold);
    parted_ = std::max(std::ranges::max(distances), kept);
    seen_ = frame;
    if (mark_.parted == 0) mark_.parted = parted_;
    excuses_ = parted_ >= good_share * std::max(error.error(), matters * error.allowed());
    sensitive_ = sensitive_ || excuses_;
    if (!excuses_ || parted_ < error.error()) covered_ = frame;
    lost_ = seconds(frame - covered_) >= lasting;
    if (seconds(frame - mark_.frame) >= patience && !sensitive_) {
        runs_ = parted_ >= growth * mark_.parted;
        if (!runs_) ended_ = frame;
        mark_ = {frame, parted_};
    }
    if (lost_) runs_ = false;
}

void note_motion(const MotionError& error, const Sensitivity& sensitivity, FrameEffort& effort) {
    if (sensitivity.parted() > 0) effort.parted = sensitivity.parted();
    effort.sensitive = sensitivity.is_sensitive();
    if (sensitivity.is_lost()) return;
    effort.position_error = error.error();
    effort.position_error_at_end = error.at_end();
    effort.position_allowed = error.allowed();
}

}  // namespace drape
