#include "control/substep_control.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cloth/companions.h"
#include "control/motion_error.h"

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
/// Substeps longer than a swing needs are tried where the share of the error is below half of `comfort`. Of the error's
/// growth so much is left from one comparison to the next (1/e in half a second), since two runs of a swing meet now
/// and then.
constexpr double calm_comfort = 0.3, calm_kept = 0.82;
/// Where more substeps do not reduce the motion's error, fewer substeps are used as long as they increase it by less
/// than this factor.
constexpr double unpredictable_slack = 6;
/// A sensitive run promises means but no positions, so the error of its motion may be so many times as large.
constexpr double sensitive_slack = 3;

}  // namespace

SubstepControl::SubstepControl(const Method& method, std::uint32_t proposed, const Floors& floors,
                               std::uint32_t probe_length)
    : ladder_{method, substep_rungs(method), 0, 0, 0}, probe_length_(probe_length) {
    ladder_.lowest = rung_of(floors.least);
    ladder_.calm = std::max(ladder_.lowest, rung_of(floors.calm));
    ladder_.proposed = std::max(ladder_.calm, rung_of(proposed));
    rung_ = ladder_.proposed;
}

/// Returns the first rung with at least so many substeps, or the top.
std::size_t SubstepControl::rung_of(double substeps) const {
    const auto place = std::ranges::find_if(ladder_.rungs, [&](std::uint32_t rung) { return rung >= substeps; });
    return std::min(static_cast<std::size_t>(place - ladder_.rungs.begin()), ladder_.rungs.size() - 1);
}

const Segment& SubstepControl::begin(std::uint32_t room, bool eventful) {
    if (eventful) {
        probes_.interval = 1;
        probes_.until = 0;
        return_to_calm();
        calm_.wait = calm_after;
    }
    const std::size_t wanted = eventful ? std::min(rung_ + 2, ladder_.rungs.size() - 1) : rung_;
    attempt_ = {.room = room, .began = rung_, .rung = std::max(wanted, contact_.rung), .needed = ladder_.lowest};
    const bool probes = probes_.until == 0 && can_probe();
    segment_ = {ladder_.rungs[attempt_.rung], probes ? std::min(room, probe_length_) : 1, probes};
    return segment_;
}

SubstepControl::Verdict SubstepControl::judge(const Judgement& judgement) {
    if (lags_alike(judgement)) contact_.until_lag = lag_pause * probe_length_;
    const double lag = contact_.until_lag == 0 && !can_probe() ? judgement.lag : 0;
    contact_.rung = rung_of(std::max(judgement.passage, lag) * segment_.substeps);
    if (attempt_.turned_back) return accept_unpredictable(judgement);
    if (judgement.sensitive) slack_ = std::max(slack_, sensitive_slack);
    const double worst = std::max(judgement.excess(), judgement.motion / motion_slack());
    if (worst <= 1 && passes(judgement)) return follow(judgement.passage);
    if (worst <= 1 && lags(judgement) && can_probe()) return probe_instead();
    if (worst <= 1 && lags(judgement)) {
        if (attempt_.lagged.substeps == 0) attempt_.lagged = {static_cast<double>(segment_.substeps), judgement.lag};
        return follow(std::min(judgement.lag, most_lag_followed));
    }
    if (segment_.probes) learn_order(judgement);
    if (worst <= 1) {
        succeed(judgement);
        return slack_ > 1 && judgement.motion > 1 ? Verdict::unpredictable : Verdict::keep;
    }
    if (attempt_.top_motion > 0) return look_back(judgement);
    if (turn_back(judgement)) return try_again_with(*attempt_.only_motion_failed);
    if (futile(judgement)) return take_best(judgement);
    if (at_top()) {
        if (!worth_looking_back(judgement)) return Verdict::give_up;
        attempt_.top_motion = judgement.motion;
        return try_again_with(rung_of(ladder_.rungs.back() / 4.0));
    }
    refine(judgement);
    return Verdict::again;
}

FailedAttempt SubstepControl::failure(const Judgement& judgement) const {
    const std::uint32_t substeps = segment_.substeps;
    if (!(judgement.watch <= 1)) return {substeps, Criterion::watch, judgement.watch};
    if (!(judgement.stretch <= 1)) return {substeps, Criterion::stretch, judgement.stretch};
    if (!(judgement.motion / motion_slack() <= 1)) return {substeps, Criterion::motion, judgement.motion};
    if (passes(judgement)) return {substeps, Criterion::passage, judgement.passage};
    return {substeps, Criterion::lag, judgement.lag};
}

/// Returns by what factor the motion's error may grow faster than its limit allows. An error that is k times what is
/// allowed until now stays so while it grows k times as fast: finer steps take time and mend nothing. The companion's
/// error is known within a factor, which is as much as is followed.
double SubstepControl::motion_slack() const {
    const double share = std::isnan(trend_.share) ? 0 : std::min(trend_.share, motion_error_confidence);
    return std::max(slack_, share);
}

/// Returns whether, at the top rung, the motion alone fails, and a quarter of its substeps has not been tried to see
/// whether more substeps help.
bool SubstepControl::worth_looking_back(const Judgement& judgement) const {
    return !attempt_.hopeless && segment_.probes && judgement.excess() <= 1 && std::isfinite(judgement.motion);
}

/// Returns whether a drawn triangle may pass a collider, which more substeps would prevent. The attempt with a quarter
/// of the top's substeps is judged by its motion alone.
bool SubstepControl::passes(const Judgement& judgement) const {
    return judgement.passage > 1 && !at_top() && attempt_.top_motion == 0;
}

/// Returns whether truncation held a particle back, or angular momentum was made, by so much that the motion may be
/// wrong. A probe measures how wrong it is, so there lags are none.
bool SubstepControl::lags(const Judgement& judgement) const {
    return judgement.lag > 1 && !segment_.probes && !at_top() && attempt_.top_motion == 0 && contact_.until_lag == 0 &&
           !lags_alike(judgement);
}

/// Does the frame again as the first of a probe with as many substeps, which tells by how much a lag makes the motion
/// wrong.
SubstepControl::Verdict SubstepControl::probe_instead() {
    segment_.frame_count = std::min(attempt_.room, probe_length_);
    segment_.probes = true;
    probes_.interval = 1;
    return Verdict::again;
}

/// Returns whether more substeps have hardly reduced the segment's lag, by less than their square root: springs press
/// cloth together, or pull it tight, as far as they would in any step.
bool SubstepControl::lags_alike(const Judgement& judgement) const {
    return judgement.lag > 1 && attempt_.lagged.substeps > 0 && segment_.substeps > attempt_.lagged.substeps &&
           judgement.lag > attempt_.lagged.lag / std::sqrt(segment_.substeps / attempt_.lagged.substeps);
}

/// Takes the number of substeps at which motions that are `excess` times too long become short enough. It says nothing
/// about what other frames need.
SubstepControl::Verdict SubstepControl::follow(double excess) {
    constexpr double margin = 1.2;  // with more substeps, the motion that is followed may be faster
    return try_again_with(std::max(attempt_.rung + 1, rung_of(margin * excess * segment_.substeps)));
}

SubstepControl::Verdict SubstepControl::try_again_with(std::size_t rung) {
    attempt_.rung = rung;
    segment_.substeps = ladder_.rungs[attempt_.rung];
    return Verdict::again;
}

/// Returns whether more substeps broke a motion that fewer followed only too inexactly: the strain that a long step
/// leaves in rigid cloth becomes speed when the step shrinks a hundredfold.
bool SubstepControl::turn_back(const Judgement& judgement) {
    const bool only_motion =
        judgement.plausible && judgement.excess() <= 1 && std::isfinite(judgement.motion) && !passes(judgement);
    if (only_motion) attempt_.only_motion_failed = attempt_.rung;
    attempt_.turned_back = !judgement.plausible && attempt_.only_motion_failed.has_value();
    return attempt_.turned_back;
}

/// Judges the attempt with a quarter of the top's substeps.
SubstepControl::Verdict SubstepControl::look_back(const Judgement& judgement) {
    const bool as_good = judgement.excess() <= 1 && judgement.motion < 2 * attempt_.top_motion;
    attempt_.top_motion = 0;
    if (as_good) return accept_unpredictable(judgement);
    attempt_.hopeless = true;
    return try_again_with(ladder_.rungs.size() - 1);
}

SubstepControl::Verdict SubstepControl::accept_unpredictable(const Judgement& judgement) {
    slack_ = unpredictable_slack * judgement.motion;
    succeed(judgement);
    rung_ = attempt_.turned_back ? attempt_.rung : std::max(attempt_.began, attempt_.needed);
    probes_.until = 0;
    return Verdict::unpredictable;
}

/// More substeps hardly helped: goes back to the attempt with the smallest error, which need not have the most
/// substeps.
SubstepControl::Verdict SubstepControl::take_best(const Judgement& judgement) {
    if (attempt_.before.motion >= judgement.motion) return accept_unpredictable(judgement);
    attempt_.turned_back = true;
    return try_again_with(rung_of(attempt_.before.substeps));
}

void SubstepControl::accumulated(const Trend& trend) {
    if (resolves())
        follow_share(trend.share);
    else
        follow_calm(trend);
    trend_ = trend;
}

/// Takes the substeps that a swing needs at least. Every change of the substeps shakes cloth a little, so after each
/// return until the next event it waits twice as long before it goes below them again.
void SubstepControl::return_to_calm() {
    const std::uint32_t wait = rung_ < ladder_.calm ? std::min(2 * calm_.wait, longest_calm) : calm_.wait;
    rung_ = std::max(rung_, ladder_.calm);
    calm_ = {.wait = wait};
}

/// Returns whether a lower rung, not below the companion's substeps, is expected to keep far from the limits. The
/// companion's distance is that of a run with its substeps, and the error was derived from it by the least order of
/// convergence: between the two runs no higher order makes the error larger. What a tenth of a second adds is bounded
/// by the limit, which gives it more room than what has been added since the start.
bool SubstepControl::is_calm_at(std::size_t rung, double share, double stretch) const {
    const double longer = static_cast<double>(ladder_.rungs[rung_]) / ladder_.rungs[rung];
    const double grows = std::pow(longer, error_order(ladder_.method, true));
    return std::max(share * grows, stretch * longer * longer) < calm_comfort && calm_.growth * grows < comfort;
}

/// Goes below the substeps that a swing needs, to the companion's at most, while the companion shows that the error
/// stays far below its limit; goes back to them where it does not, or where nothing is known. The error of a motion
/// that has just begun grows ever faster, so nothing is expected of it while its growth rises.
void SubstepControl::follow_calm(const Trend& trend) {
    const double stretch = std::exchange(calm_.stretch, 0.0);
    if (std::isnan(trend.growth)) return return_to_calm();
    calm_.growth = std::max(trend.growth, calm_.growth * calm_kept);
    if (std::max(stretch, trend.share) > comfort || calm_.growth > 1) return return_to_calm();
    const bool shown = calm_.frames >= calm_.wait * probe_length_ && trend.growth <= trend_.growth;
    if (!shown || rung_ > ladder_.calm) return;
    const std::uint32_t beside = companion_substeps(ladder_.method, ladder_.rungs[rung_]);
    std::size_t rung = rung_;
    while (rung > ladder_.lowest && ladder_.rungs[rung - 1] >= beside && is_calm_at(rung - 1, trend.share, stretch))
        --rung;
    rung_ = rung;
}

/// Without probes the companion alone shows whether the motion needs more substeps than the method's law proposed.
void SubstepControl::follow_share(double share) {
    constexpr double high = 0.5, low = 0.1;
    if (share > high && share >= trend_.share && rung_ < std::min(ladder_.proposed + 6, ladder_.rungs.size() - 1))
        ++rung_;
    else if (share < low && rung_ > ladder_.proposed)
        --rung_;
}

/// Returns whether more substeps have hardly reduced the segment's error of motion: by less than their square root.
bool SubstepControl::hardly_fell(const Judgement& judgement) const {
    return judgement.motion > attempt_.before.motion / std::sqrt(segment_.substeps / attempt_.before.substeps);
}

/// Returns whether four times the substeps or more have hardly reduced the segment's error of motion.
bool SubstepControl::futile(const Judgement& judgement) const {
    if (judgement.excess() > 1 || !std::isfinite(judgement.motion) || !std::isfinite(attempt_.before.motion))
        return false;
    if (passes(judgement)) return false;
    return attempt_.before.substeps > 0 && segment_.substeps >= 4 * attempt_.before.substeps && hardly_fell(judgement);
}

/// Learns the order of convergence from two probes: of the same frames, or, with less weight, of different ones.
/// Contact and crumpling leave less than the second order of free motion.
void SubstepControl::learn_order(const Judgement& judgement) {
    const Tried now{static_cast<double>(segment_.substeps), judgement.motion};
    const double seen = std::log(probes_.last.motion / now.motion) / std::log(now.substeps / probes_.last.substeps);
    if (probes_.last.substeps > 0 && now.substeps != probes_.last.substeps && std::isfinite(seen)) {
        const double order = std::clamp(seen, 1.0, 2.0);
        probes_.order = now.substeps > probes_.last.substeps ? order : 0.5 * (probes_.order + order);
    }
    probes_.last = now;
}

/// Returns the factor by which a failed attempt wants more substeps. The stretch error falls about with their square,
/// the motion's as attempts have shown. Where it hardly fell, the next attempt shows whether anything helps (futile).
double SubstepControl::wanted_factor(const Judgement& judgement) const {
    constexpr double margin = 1.1, most = 4;
    const double motion = judgement.motion / motion_slack();
    double factor = margin * std::sqrt(judgement.excess());
    if (judgement.excess() <= 1 && attempt_.before.substeps > 0 && hardly_fell(judgement))
        factor = most * attempt_.before.substeps / segment_.substeps;
    else if (motion > 1)
        factor = std::max(factor, margin * std::pow(motion, 1 / probes_.order));
    return std::clamp(factor, 1.0, most);
}

void SubstepControl::refine(const Judgement& judgement) {
    const double factor = wanted_factor(judgement);
    if (judgement.excess() > 1) attempt_.needed = attempt_.rung + 1;
    const bool measured = segment_.probes && judgement.excess() <= 1;  // otherwise the motion's error is not known
    if (measured && (attempt_.before.substeps == 0 || segment_.substeps >= 4 * attempt_.before.substeps))
        attempt_.before = {static_cast<double>(segment_.substeps), judgement.motion};
    attempt_.rung = std::max(attempt_.rung + 1, rung_of(factor * segment_.substeps));
    segment_.substeps = ladder_.rungs[attempt_.rung];
    if (easing_.since_fewer < 8 * probe_length_) easing_.patience = std::min(2 * easing_.patience, 16u);
    easing_.since_fewer = 1000000;
    easing_.easy = 0;
    probes_.interval = 1;
    rung_ = attempt_.rung;
}

void SubstepControl::keep_anyway() { succeed({.stretch = 1, .motion = 1}); }

void SubstepControl::succeed(const Judgement& judgement) {
    easing_.since_fewer += segment_.frame_count;
    calm_.frames += segment_.frame_count;
    calm_.stretch = std::max(calm_.stretch, judgement.stretch);
    contact_.until_lag -= std::min(contact_.until_lag, segment_.frame_count);
    if (!segment_.probes) {
        if (probes_.until > 0) --probes_.until;
        return;
    }
    slack_ = std::max(1.0, std::min(slack_, unpredictable_slack * judgement.motion));
    probes_.until = probes_.interval * probe_length_;
    // The companion notices what happens between probes, so few probes are enough far from the limit.
    constexpr double far = 0.3;
    probes_.interval = std::min((trend_.share < far ? 4 : 2) * probes_.interval, longest_interval);
    if (judgement.lag > 1) contact_.until_lag = probes_.until;  // the probe found the motion right in spite of it
    consider_fewer(judgement);
}

/// Returns the errors, divided by their limits, that a probe predicts for a lower rung: the motion's error grows with
/// the order that the probe showed, the stretch error as it did towards half the substeps.
double SubstepControl::expected(const Judgement& judgement, std::size_t rung) const {
    const double longer = static_cast<double>(ladder_.rungs[attempt_.rung]) / ladder_.rungs[rung];
    const double growth = std::max(judgement.coarse_stretch, 1e-12) / std::max(judgement.stretch, 1e-12);
    const double stretch = judgement.stretch * std::pow(std::max(growth, 1.0), std::log2(longer));
    return std::max(judgement.motion / motion_slack() * std::pow(longer, probes_.order), stretch);
}

/// Goes down after a few easy probes, at once after a very easy one: as far as errors stay small, to a quarter of the
/// substeps at most.
void SubstepControl::consider_fewer(const Judgement& judgement) {
    if (rung_ <= ladder_.calm) return;
    const double next = expected(judgement, rung_ - 1);
    easing_.easy = next < comfort ? easing_.easy + 1 : 0;
    if (easing_.easy > 0) probes_.until = std::min(probes_.until, probe_length_);
    if (next >= very_easy * comfort && easing_.easy < easing_.patience) return;
    std::size_t rung = rung_;
    while (rung > ladder_.calm && 4 * ladder_.rungs[rung - 1] >= ladder_.rungs[attempt_.rung] &&
           expected(judgement, rung - 1) < comfort)
        --rung;
    if (rung == rung_) return;
    easing_.easy = 0;
    easing_.since_fewer = 0;
    rung_ = rung;
    probes_.interval = 1;
    probes_.until = 0;
}

}  // namespace drape
