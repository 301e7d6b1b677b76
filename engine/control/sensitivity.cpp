#include "control/sensitivity.h"

#include <algorithm>
#include <limits>

namespace drape {

namespace {

/// The disturbed run begins when the estimated error is this share of the allowed one; there the substep control begins
/// to react to it.
constexpr double matters = 0.7;
/// Runs that began a millionth apart, and have diverged by this share of the estimated error, soon diverge by all of
/// it.
constexpr double as_far = 0.1;
/// s: the disturbed run ends after `patience` if it has not diverged by the share `on_the_way` of the error, and after
/// `most_patience` in any case.
constexpr double patience = 1, most_patience = 3, on_the_way = 0.01;
/// s until a disturbed run may begin again.
constexpr double pause = 2;

}  // namespace

bool Sensitivity::begins(std::uint32_t frame, const MotionError& error, bool predictable) const {
    if (runs_ || sensitive_ || (predictable && !(error.share() > matters))) return false;
    return ended_ == 0 || frame - ended_ > pause * model_.scene.time.fps;
}

void Sensitivity::begin(std::uint32_t frame) {
    runs_ = true;
    begun_ = frame;
    parted_ = 0;
}

void Sensitivity::saw(std::uint32_t frame, std::span<const double> distances, const MotionError& error) {
    parted_ = *std::ranges::max_element(distances);
    const double scale = error.share() > 0 ? error.error() * std::max(1.0, matters / error.share())
                                           : std::numeric_limits<double>::infinity();
    sensitive_ = parted_ >= as_far * scale;
    const double lasted = (frame - begun_) / model_.scene.time.fps;
    const bool is_vain = lasted > most_patience || (lasted > patience && parted_ < on_the_way * scale);
    runs_ = !sensitive_ && !is_vain;
    if (!runs_) ended_ = frame;
}

void note_motion(const MotionError& error, const Sensitivity& sensitivity, FrameEffort& effort) {
    if (sensitivity.parted() > 0) effort.parted = sensitivity.parted();
    effort.sensitive = sensitivity.is_sensitive();
    if (effort.sensitive) return;
    effort.position_error = error.error();
    effort.position_error_at_end = error.at_end();
    effort.position_allowed = error.allowed();
}

}  // namespace drape
