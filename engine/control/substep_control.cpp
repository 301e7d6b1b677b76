#include "control/substep_control.h"

#include <algorithm>
#include <cmath>

namespace drape {

namespace {

/// The frames between two probes are at most so many times a probe's length. A probe costs half as much as its frames:
/// 1 in 1 + 12 is 4 %.
constexpr std::uint32_t longest_interval = 12;
/// Where more substeps do not reduce a lag, lags are ignored for this many times a probe's frames.
constexpr std::uint32_t lag_pause = 12;
/// A lag of more than this many times its limit first gets the substeps of one of this size.
constexpr double most_lag_followed = 3;
/// Fewer substeps are tried where their errors are expected to be below this share of the limits.
constexpr double comfort = 0.6;
/// Fewer substeps are tried without waiting where the errors are below this share of `comfort`.
constexpr double very_easy = 0.2;
/// Where more substeps do not reduce the motion's error, fewer substeps are used as long as they increase it by less
/// than this factor.
constexpr double unpredictable_slack = 6;
/// A sensitive run promises means but no positions, so the error of its motion may be so many times as large.
constexpr double sensitive_slack = 3;

}  // namespace

SubstepControl::SubstepControl(const Method& method, std::uint32_t proposed, std::uint32_t least,
                               std::uint32_t probe_length)
    : rungs_(substep_rungs(method)),
      resolves_(method.trust == Method::Trust::resolves),
      probe_length_(probe_length),
      lowest_(rung_of(least)),
      proposed_(std::max(lowest_, rung_of(proposed))),
      rung_(proposed_) {}

/// Returns the first rung with at least so many substeps, or the top.
std::size_t SubstepControl::rung_of(double substeps) const {
    const auto place = std::ranges::find_if(rungs_, [&](std::uint32_t rung) { return rung >= substeps; });
    return std::min(static_cast<std::size_t>(place - rungs_.begin()), rungs_.size() - 1);
}

const Segment& SubstepControl::begin(std::uint32_t room, bool eventful) {
    if (eventful) interval_ = 1;
    if (eventful) until_probe_ = 0;
    tried_ = std::max(eventful ? std::min(rung_ + 2, rungs_.size() - 1) : rung_, passage_rung_);
    const bool probes = until_probe_ == 0 && room >= 2 && !resolves_;
    began_ = rung_;
    before_ = {};
    top_motion_ = 0;
    hopeless_ = false;
    only_motion_failed_.reset();
    turned_back_ = false;
    needed_ = lowest_;
    lagged_ = {};
    segment_ = {rungs_[tried_], probes ? std::min(room, probe_length_) : 1, probes};
    return segment_;
}

SubstepControl::Verdict SubstepControl::judge(const Judgement& judgement) {
    if (lags_alike(judgement)) until_lag_ = lag_pause * probe_length_;
    const double lag = until_lag_ == 0 ? judgement.lag : 0;
    passage_rung_ = rung_of(std::max(judgement.passage, lag) * segment_.substeps);
    if (turned_back_) return accept_unpredictable(judgement);
    if (judgement.sensitive) slack_ = std::max(slack_, sensitive_slack);
    const double worst = std::max(judgement.excess(), judgement.motion / slack_);
    if (worst <= 1 && passes(judgement)) return follow(judgement.passage);
    if (worst <= 1 && lags(judgement)) {
        if (lagged_.substeps == 0) lagged_ = {static_cast<double>(segment_.substeps), judgement.lag};
        return follow(std::min(judgement.lag, most_lag_followed));
    }
    if (segment_.probes) learn_order(judgement);
    if (worst <= 1) {
        succeed(judgement);
        return slack_ > 1 && judgement.motion > 1 ? Verdict::unpredictable : Verdict::keep;
    }
    if (top_motion_ > 0) return look_back(judgement);
    if (turn_back(judgement)) return try_again_with(*only_motion_failed_);
    if (futile(judgement)) return take_best(judgement);
    if (at_top()) {
        if (!worth_looking_back(judgement)) return Verdict::give_up;
        top_motion_ = judgement.motion;
        return try_again_with(rung_of(rungs_.back() / 4.0));
    }
    refine(judgement);
    return Verdict::again;
}

FailedAttempt SubstepControl::failure(const Judgement& judgement) const {
    const std::uint32_t substeps = segment_.substeps;
    if (!(judgement.watch <= 1)) return {substeps, Criterion::watch, judgement.watch};
    if (!(judgement.stretch <= 1)) return {substeps, Criterion::stretch, judgement.stretch};
    if (!(judgement.motion / slack_ <= 1)) return {substeps, Criterion::motion, judgement.motion};
    if (passes(judgement)) return {substeps, Criterion::passage, judgement.passage};
    return {substeps, Criterion::lag, judgement.lag};
}

/// Returns whether, at the top rung, the motion alone fails, and a quarter of its substeps has not been tried to see
/// whether more substeps help.
bool SubstepControl::worth_looking_back(const Judgement& judgement) const {
    return !hopeless_ && segment_.probes && judgement.excess() <= 1 && std::isfinite(judgement.motion);
}

/// Returns whether a drawn triangle may pass a collider, which more substeps would prevent. The attempt with a quarter
/// of the top's substeps is judged by its motion alone.
bool SubstepControl::passes(const Judgement& judgement) const {
    return judgement.passage > 1 && !at_top() && top_motion_ == 0;
}

/// Returns whether truncation held a particle back that more substeps would let move on.
bool SubstepControl::lags(const Judgement& judgement) const {
    return judgement.lag > 1 && !at_top() && top_motion_ == 0 && until_lag_ == 0 && !lags_alike(judgement);
}

/// Returns whether more substeps have hardly reduced the segment's lag, by less than their square root: springs press
/// cloth together, or pull it tight, as far as they would in any step.
bool SubstepControl::lags_alike(const Judgement& judgement) const {
    return judgement.lag > 1 && lagged_.substeps > 0 && segment_.substeps > lagged_.substeps &&
           judgement.lag > lagged_.lag / std::sqrt(segment_.substeps / lagged_.substeps);
}

/// Takes the number of substeps at which motions that are `excess` times too long become short enough. It says nothing
/// about what other frames need.
SubstepControl::Verdict SubstepControl::follow(double excess) {
    constexpr double margin = 1.2;  // with more substeps, the motion that is followed may be faster
    return try_again_with(std::max(tried_ + 1, rung_of(margin * excess * segment_.substeps)));
}

SubstepControl::Verdict SubstepControl::try_again_with(std::size_t rung) {
    tried_ = rung;
    segment_.substeps = rungs_[tried_];
    return Verdict::again;
}

/// Returns whether more substeps broke a motion that fewer followed only too inexactly: the strain that a long step
/// leaves in rigid cloth becomes speed when the step shrinks a hundredfold.
bool SubstepControl::turn_back(const Judgement& judgement) {
    const bool only_motion =
        judgement.plausible && judgement.excess() <= 1 && std::isfinite(judgement.motion) && !passes(judgement);
    if (only_motion) only_motion_failed_ = tried_;
    turned_back_ = !judgement.plausible && only_motion_failed_.has_value();
    return turned_back_;
}

/// Judges the attempt with a quarter of the top's substeps.
SubstepControl::Verdict SubstepControl::look_back(const Judgement& judgement) {
    const bool as_good = judgement.excess() <= 1 && judgement.motion < 2 * top_motion_;
    top_motion_ = 0;
    if (as_good) return accept_unpredictable(judgement);
    hopeless_ = true;
    return try_again_with(rungs_.size() - 1);
}

SubstepControl::Verdict SubstepControl::accept_unpredictable(const Judgement& judgement) {
    slack_ = unpredictable_slack * judgement.motion;
    succeed(judgement);
    rung_ = turned_back_ ? tried_ : std::max(began_, needed_);
    until_probe_ = 0;
    return Verdict::unpredictable;
}

/// More substeps hardly helped: goes back to the attempt with the smallest error, which need not have the most
/// substeps.
SubstepControl::Verdict SubstepControl::take_best(const Judgement& judgement) {
    if (before_.motion >= judgement.motion) return accept_unpredictable(judgement);
    turned_back_ = true;
    return try_again_with(rung_of(before_.substeps));
}

void SubstepControl::accumulated(double share) {
    if (resolves_) follow_share(share);
    share_ = share;
}

/// Without probes the companion alone shows whether the motion needs more substeps than the method's law proposed.
void SubstepControl::follow_share(double share) {
    constexpr double high = 0.5, low = 0.1;
    if (share > high && share >= share_ && rung_ < std::min(proposed_ + 6, rungs_.size() - 1))
        ++rung_;
    else if (share < low && rung_ > proposed_)
        --rung_;
}

/// Returns whether more substeps have hardly reduced the segment's error of motion: by less than their square root.
bool SubstepControl::hardly_fell(const Judgement& judgement) const {
    return judgement.motion > before_.motion / std::sqrt(segment_.substeps / before_.substeps);
}

/// Returns whether four times the substeps or more have hardly reduced the segment's error of motion.
bool SubstepControl::futile(const Judgement& judgement) const {
    if (judgement.excess() > 1 || !std::isfinite(judgement.motion) || !std::isfinite(before_.motion)) return false;
    if (passes(judgement)) return false;
    return before_.substeps > 0 && segment_.substeps >= 4 * before_.substeps && hardly_fell(judgement);
}

/// Learns the order of convergence from two probes: of the same frames, or, with less weight, of different ones.
/// Contact and crumpling leave less than the second order of free motion.
void SubstepControl::learn_order(const Judgement& judgement) {
    const Tried now{static_cast<double>(segment_.substeps), judgement.motion};
    const double seen = std::log(probed_.motion / now.motion) / std::log(now.substeps / probed_.substeps);
    if (probed_.substeps > 0 && now.substeps != probed_.substeps && std::isfinite(seen)) {
        const double order = std::clamp(seen, 1.0, 2.0);
        order_ = now.substeps > probed_.substeps ? order : 0.5 * (order_ + order);
    }
    probed_ = now;
}

/// Returns the factor by which a failed attempt wants more substeps. The stretch error falls about with their square,
/// the motion's as attempts have shown. Where it hardly fell, the next attempt shows whether anything helps (futile).
double SubstepControl::wanted_factor(const Judgement& judgement) const {
    constexpr double margin = 1.1, most = 4;
    const double motion = judgement.motion / slack_;
    double factor = margin * std::sqrt(judgement.excess());
    if (judgement.excess() <= 1 && before_.substeps > 0 && hardly_fell(judgement))
        factor = most * before_.substeps / segment_.substeps;
    else if (motion > 1)
        factor = std::max(factor, margin * std::pow(motion, 1 / order_));
    return std::clamp(factor, 1.0, most);
}

void SubstepControl::refine(const Judgement& judgement) {
    const double factor = wanted_factor(judgement);
    if (judgement.excess() > 1) needed_ = tried_ + 1;
    const bool measured = segment_.probes && judgement.excess() <= 1;  // otherwise the motion's error is not known
    if (measured && (before_.substeps == 0 || segment_.substeps >= 4 * before_.substeps))
        before_ = {static_cast<double>(segment_.substeps), judgement.motion};
    tried_ = std::max(tried_ + 1, rung_of(factor * segment_.substeps));
    segment_.substeps = rungs_[tried_];
    if (since_fewer_ < 8 * probe_length_) patience_ = std::min(2 * patience_, 16u);
    since_fewer_ = 1000000;
    easy_ = 0;
    interval_ = 1;
    rung_ = tried_;
}

void SubstepControl::keep_anyway() { succeed({.stretch = 1, .motion = 1}); }

void SubstepControl::succeed(const Judgement& judgement) {
    since_fewer_ += segment_.frame_count;
    until_lag_ -= std::min(until_lag_, segment_.frame_count);
    if (!segment_.probes) {
        if (until_probe_ > 0) --until_probe_;
        return;
    }
    slack_ = std::max(1.0, std::min(slack_, unpredictable_slack * judgement.motion));
    until_probe_ = interval_ * probe_length_;
    // The companion notices what happens between probes, so few probes are enough far from the limit.
    constexpr double far = 0.3;
    interval_ = std::min((share_ < far ? 4 : 2) * interval_, longest_interval);
    consider_fewer(judgement);
}

/// Returns the errors, divided by their limits, that a probe predicts for a lower rung: the motion's error grows with
/// the order that the probe showed, the stretch error as it did towards half the substeps.
double SubstepControl::expected(const Judgement& judgement, std::size_t rung) const {
    const double longer = static_cast<double>(rungs_[tried_]) / rungs_[rung];
    const double growth = std::max(judgement.coarse_stretch, 1e-12) / std::max(judgement.stretch, 1e-12);
    const double stretch = judgement.stretch * std::pow(std::max(growth, 1.0), std::log2(longer));
    return std::max(judgement.motion / slack_ * std::pow(longer, order_), stretch);
}

/// Goes down after a few easy probes, at once after a very easy one: as far as errors stay small, to a quarter of the
/// substeps at most.
void SubstepControl::consider_fewer(const Judgement& judgement) {
    if (rung_ == lowest_) return;
    const double next = expected(judgement, rung_ - 1);
    easy_ = next < comfort ? easy_ + 1 : 0;
    if (easy_ > 0) until_probe_ = std::min(until_probe_, probe_length_);
    if (next >= very_easy * comfort && easy_ < patience_) return;
    std::size_t rung = rung_;
    while (rung > lowest_ && 4 * rungs_[rung - 1] >= rungs_[tried_] && expected(judgement, rung - 1) < comfort) --rung;
    if (rung == rung_) return;
    easy_ = 0;
    since_fewer_ = 0;
    rung_ = rung;
    interval_ = 1;
    until_probe_ = 0;
}

}  // namespace drape
