// Decides, for the closed loop of method `auto`, how many substeps each frame gets, from how its attempts were judged.
// The methods' laws of substeps only propose a first number. The device and the C++ twin use this same class, so they
// decide the same.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "cloth/rungs.h"
#include "drape/frame.h"

namespace drape {

/// An attempt is judged by its errors, each divided by its limit, in the worst frame and cloth. Above 1 the attempt
/// fails; a value that is not finite counts as infinite.
struct Judgement {
    double stretch = 0;         ///< of the RMS or of the worst spring, whichever is worse
    double motion = 0;          ///< measured by a probe
    double coarse_stretch = 0;  ///< the stretch of the probe's run with half the substeps
    bool plausible = true;      ///< the watch finds it plausible (control/watch.h)
    double passage =
        0;  ///< motion past colliders (control/passage_watch.h); this limit is kept as far as substeps allow
    bool sensitive = false;  ///< equally exact runs diverge (control/sensitivity.h): positions cannot be predicted
    double lag = 0;    ///< how far truncation held a particle back, or what angular momentum was made of nothing; this
                       ///< limit is kept as far as substeps help
    double watch = 0;  ///< speed, distance, energy and whatever else the watch bounds, which substeps do not cause

    double excess() const { return std::max(stretch, watch); }
};

/// Frames that are judged, and kept or done again, together: a single frame, or the few of a probe, which are also
/// simulated with half the substeps and compared at their end.
struct Segment {
    std::uint32_t substeps;
    std::uint32_t frame_count;
    bool probes;
    bool operator==(const Segment&) const = default;
};

/// The companion shows this where it was compared, divided by what the motion's limit allows (control/motion_error.h):
/// the position error, and how fast it grew since the last comparison. Not numbers: not known.
struct Trend {
    double share = std::numeric_limits<double>::quiet_NaN(), growth = std::numeric_limits<double>::quiet_NaN();
};

class SubstepControl {
  public:
    /// The least numbers of substeps: of any frame, and of those in which the companion does not show the error far
    /// below its limit.
    struct Floors {
        std::uint32_t least, calm;
    };
    /// The control begins with `proposed` substeps; a probe has `probe_length` frames, 2 or more.
    SubstepControl(const Method& method, std::uint32_t proposed, const Floors& floors, std::uint32_t probe_length);

    /// Returns the first attempt at the next frames. `room` is how many frames a probe from here on may have.
    /// `eventful` means that the scene announces an event in the first of them (drive.h): the segment then begins with
    /// more substeps, and with a probe.
    const Segment& begin(std::uint32_t room, bool eventful);
    /// `unpredictable` frames are kept, though the motion's error is above its limit, since more substeps do not reduce
    /// it: the cloth crumples, and neighbouring motions diverge whatever is done.
    enum class Verdict { keep, unpredictable, again, give_up };
    /// Judges the attempt that `segment` describes. After `again`, `segment` describes the next attempt.
    Verdict judge(const Judgement& judgement);
    /// Returns by what an attempt fails that `judge` wants again; it is asked before `judge`.
    FailedAttempt failure(const Judgement& judgement) const;
    /// Returns whether the frames that an attempt has done so far make it fail, so that the others need not be
    /// simulated.
    bool fails(const Judgement& judgement) const {
        return (judgement.excess() > 1 && !at_top()) || passes(judgement) || lags(judgement);
    }
    const Segment& segment() const { return segment_; }
    bool at_top() const { return attempt_.rung + 1 == ladder_.rungs.size(); }
    /// Keeps the frames although the last judgement failed.
    void keep_anyway();
    /// Takes, after a segment was kept, what is known of the position error; a share of 0 where the motion itself is
    /// chaotic. Far from the limit probes become rarer, and substeps may be longer than a swing needs; near it, methods
    /// without probes take more substeps.
    void accumulated(const Trend& trend);

    /// Passes everything that changes between segments to `archive(members...)`, which writes or reads it
    /// (byte_stream.h). Returns whether what was read is possible.
    template <class Archive>
    bool transfer(Archive& archive) {
        archive(rung_, slack_, segment_.substeps, segment_.frame_count, segment_.probes, probes_.interval,
                probes_.until, probes_.order, probes_.last.substeps, probes_.last.motion, easing_.since_fewer,
                easing_.patience, easing_.easy, contact_.rung, contact_.until_lag, trend_.share, trend_.growth,
                calm_.frames, calm_.stretch, calm_.growth, calm_.wait);
        return calm_.wait >= calm_after && calm_.wait <= longest_calm &&
               std::max(rung_, contact_.rung) < ladder_.rungs.size() && rung_ >= ladder_.lowest;
    }

  private:
    /// Returns whether the method needs no probe.
    bool resolves() const { return ladder_.method.trust == Method::Trust::resolves; }
    bool can_probe() const { return attempt_.room >= 2 && !resolves(); }
    Verdict probe_instead();
    std::size_t rung_of(double substeps) const;
    bool passes(const Judgement& judgement) const;
    bool lags(const Judgement& judgement) const;
    bool lags_alike(const Judgement& judgement) const;
    bool hardly_fell(const Judgement& judgement) const;
    bool futile(const Judgement& judgement) const;
    double wanted_factor(const Judgement& judgement) const;
    void follow_share(double share);
    bool is_calm_at(std::size_t rung, double share, double stretch) const;
    void follow_calm(const Trend& trend);
    void return_to_calm();
    Verdict accept_unpredictable(const Judgement& judgement);
    Verdict take_best(const Judgement& judgement);
    double motion_slack() const;
    bool worth_looking_back(const Judgement& judgement) const;
    Verdict try_again_with(std::size_t rung);
    Verdict follow(double excess);
    Verdict look_back(const Judgement& judgement);
    bool turn_back(const Judgement& judgement);
    void succeed(const Judgement& judgement);
    void refine(const Judgement& judgement);
    void learn_order(const Judgement& judgement);
    double expected(const Judgement& judgement, std::size_t rung) const;
    void consider_fewer(const Judgement& judgement);

    struct Ladder {
        const Method& method;
        std::span<const std::uint32_t> rungs;
        std::size_t lowest, calm, proposed;
    } ladder_;
    std::uint32_t probe_length_;
    std::size_t rung_;  ///< the rung for frames to come
    double slack_ = 1;  ///< factor on the motion's limit, raised where more substeps did not help
    struct Tried {
        double substeps = 0, motion = 0;
    };
    struct Lagged {
        double substeps = 0, lag = 0;
    };
    /// This is known of the attempts at the segment.
    struct Attempt {
        std::uint32_t room = 0;  ///< how many frames a probe may have
        std::size_t began = 0;   ///< the rung before the segment began
        std::size_t rung = 0;    ///< of the current attempt
        std::size_t needed = 0;  ///< the lowest rung that keeps the segment's stretch
        Tried before = {};       ///< a failed attempt, which shows whether more substeps help
        double top_motion = 0;   ///< the motion's error at the top rung, while a quarter of its substeps is tried
        bool hopeless =
            false;  ///< a quarter of the top's substeps was worse: more substeps would help, but there are none
        /// The attempt with the most substeps that failed by its motion alone.
        std::optional<std::size_t> only_motion_failed = {};
        bool turned_back = false;  ///< the segment went back to an earlier attempt
        Lagged lagged = {};        ///< the first attempt whose lag was above its limit
    } attempt_;
    Segment segment_{};
    struct Contact {
        /// The rung that passages and lags of the last attempt ask for. It lasts for the frames in which something
        /// passes a collider fast, or cloths meet fast; later frames use `rung_` again.
        std::size_t rung = 0;
        std::uint32_t until_lag = 0;  ///< frames until lags count again, after more substeps did not reduce one
    } contact_;
    struct Probes {
        std::uint32_t interval = 1, until = 0;  ///< frames from one probe to the next, and those left until the next
        double order = 2;                       ///< the power of the substep with which the motion's error falls
        Tried last = {};
    } probes_;
    struct Easing {
        std::uint32_t since_fewer = 1000000;  ///< frames since the substeps went down
        std::uint32_t patience = 1,
                      easy = 0;  ///< easy probes required before the substeps go down, and their count so far
    } easing_;
    Trend trend_ = {};  ///< at the last comparison
    /// Two comparisons with the companion show whether the error's growth rises.
    static constexpr std::uint32_t calm_after = 2, longest_calm = 1024;
    struct Calm {
        std::uint32_t frames = 0;         ///< since the start, an event, or an error that was too large
        double stretch = 0;               ///< the worst since the last comparison
        double growth = 0;                ///< of the error, held for a while
        std::uint32_t wait = calm_after;  ///< probes' times until the substeps may go below those of a swing
    } calm_;
};

}  // namespace drape
