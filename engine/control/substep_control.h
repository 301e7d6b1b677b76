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

/// The share that is reported for a run without a companion (SubstepControl::accumulated).
inline constexpr double unknown_share = std::numeric_limits<double>::quiet_NaN();

class SubstepControl {
  public:
    /// The control begins with `proposed` substeps and never goes below `least`; a probe has `probe_length` frames, 2
    /// or more.
    SubstepControl(const Method& method, std::uint32_t proposed, std::uint32_t least, std::uint32_t probe_length);

    /// Returns the first attempt at the next frames. `room` is how many frames a probe from here on may have.
    /// `eventful` means that the scene announces an event in the first of them (drive.h): the segment then begins with
    /// more substeps, and with a probe.
    const Segment& begin(std::uint32_t room, bool eventful);
    /// `unpredictable` frames are kept, though the motion's error is above its limit, since more substeps do not reduce
    /// it: the cloth crumples, and neighbouring motions diverge whatever is done.
    enum class Verdict { keep, unpredictable, again, give_up };
    /// Judges the attempt that `segment` describes. After `again`, `segment` describes the next attempt.
    Verdict judge(const Judgement& judgement);
    /// Returns whether the frames that an attempt has done so far make it fail, so that the others need not be
    /// simulated.
    bool fails(const Judgement& judgement) const {
        return (judgement.excess() > 1 && !at_top()) || passes(judgement) || lags(judgement);
    }
    const Segment& segment() const { return segment_; }
    bool at_top() const { return tried_ + 1 == rungs_.size(); }
    /// Keeps the frames although the last judgement failed.
    void keep_anyway();
    /// Takes, after a segment was kept, the motion's error since the start as a share of what its limit allows
    /// (control/motion_error.h); 0 where the motion itself is chaotic. Far from the limit probes become rarer; near it,
    /// methods without probes take more substeps. `unknown_share` counts as neither far nor near.
    void accumulated(double share);

    /// Passes everything that changes between segments to `archive(members...)`, which writes or reads it
    /// (byte_stream.h). Returns whether what was read is possible.
    template <class Archive>
    bool transfer(Archive& archive) {
        archive(rung_, began_, tried_, order_, slack_, before_.substeps, before_.motion, probed_.substeps,
                probed_.motion, top_motion_, hopeless_, only_motion_failed_, turned_back_, segment_.substeps,
                segment_.frame_count, segment_.probes, interval_, until_probe_, since_fewer_, patience_, easy_,
                passage_rung_, until_lag_, share_);
        return std::max({rung_, began_, tried_, passage_rung_, only_motion_failed_.value_or(0)}) < rungs_.size() &&
               rung_ >= lowest_;
    }

  private:
    std::size_t rung_of(double substeps) const;
    bool passes(const Judgement& judgement) const;
    bool lags(const Judgement& judgement) const;
    bool lags_alike(const Judgement& judgement) const;
    bool hardly_fell(const Judgement& judgement) const;
    bool futile(const Judgement& judgement) const;
    double wanted_factor(const Judgement& judgement) const;
    void follow_share(double share);
    Verdict accept_unpredictable(const Judgement& judgement);
    Verdict take_best(const Judgement& judgement);
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

    std::span<const std::uint32_t> rungs_;
    bool resolves_;  ///< the method needs no probe
    std::uint32_t probe_length_;
    std::size_t lowest_, proposed_;
    std::size_t rung_;       ///< the rung for frames to come
    std::size_t began_ = 0;  ///< the rung before the segment began
    std::size_t tried_ = 0;  ///< the rung of the current attempt
    double order_ = 2;       ///< the power of the substep with which the motion's error falls
    double slack_ = 1;       ///< factor on the motion's limit, raised where more substeps did not help
    struct Tried {
        double substeps = 0, motion = 0;
    } before_,               ///< a failed attempt at the segment, which shows whether more substeps help
        probed_;             ///< the last probe
    double top_motion_ = 0;  ///< the motion's error at the top rung, while a quarter of its substeps is tried
    bool hopeless_ =
        false;  ///< a quarter of the top's substeps was worse: more substeps would help, but there are none
    /// The attempt at the segment with the most substeps that failed by its motion alone.
    std::optional<std::size_t> only_motion_failed_;
    bool turned_back_ = false;  ///< the segment went back to an earlier attempt
    std::size_t needed_ = 0;    ///< the lowest rung that keeps the segment's stretch
    double share_ = 0;          ///< the motion's error as a share of the allowed one
    /// The rung that passages and lags of the last attempt ask for. It lasts for the frames in which something passes a
    /// collider fast, or cloths meet fast; later frames use `rung_` again.
    std::size_t passage_rung_ = 0;
    struct Lagged {
        double substeps = 0, lag = 0;
    } lagged_;                     ///< the segment's first attempt whose lag was above its limit
    std::uint32_t until_lag_ = 0;  ///< frames until lags count again, after more substeps did not reduce one
    Segment segment_{};
    std::uint32_t interval_ = 1,
                  until_probe_ = 0;        ///< frames from one probe to the next, and those left until the next
    std::uint32_t since_fewer_ = 1000000;  ///< frames since the substeps went down
    std::uint32_t patience_ = 1,
                  easy_ = 0;  ///< easy probes required before the substeps go down, and their count so far
};

}  // namespace drape
