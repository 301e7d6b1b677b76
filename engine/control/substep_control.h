// The closed loop of method `auto` decides how many substeps each frame gets, from how its attempts were judged. Laws
// only propose where it begins. The device's loop and the C++ twin's ask the same object, so they decide the same.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "cloth/rungs.h"

namespace drape {

/// An attempt is judged by its errors over their limits, of the worst frame and cloth. Above 1 it fails; what is not
/// finite counts as infinite.
struct Judgement {
    double stretch = 0;         ///< RMS or worst spring, whichever is worse
    double motion = 0;          ///< a probe's
    double coarse_stretch = 0;  ///< that of its run with half the substeps
    bool plausible = true;      ///< the watch finds it plausible (control/watch.h)
    double passage = 0;         ///< ways by colliders (control/passage_watch.h), which are kept as far as substeps go
    bool sensitive = false;     ///< equally exact runs part (control/sensitivity.h): positions have no truth
    double lag = 0;             ///< how far truncation held a particle back, which is kept as far as substeps help
    double watch = 0;           ///< speed, distance, energy and what else the watch bounds: not of substeps' making

    double excess() const { return std::max(stretch, watch); }
};

/// Frames of a segment are judged, kept or done again together: a single one, or the few of a probe, which are run with
/// half the substeps too and compared at their end.
struct Segment {
    std::uint32_t substeps;
    std::uint32_t frame_count;
    bool probes;
    bool operator==(const Segment&) const = default;
};

/// The share that a run without a companion tells (SubstepControl::accumulated).
inline constexpr double unknown_share = std::numeric_limits<double>::quiet_NaN();

class SubstepControl {
  public:
    /// It begins with `proposed` substeps, never has fewer than `least`; a probe has `probe_length` frames, 2 or more.
    SubstepControl(const Method& method, std::uint32_t proposed, std::uint32_t least, std::uint32_t probe_length);

    /// Returns the first attempt at the next frames. `room` is how many a probe may have from here on. `eventful` means
    /// that the scene tells of something in the first of them (drive.h), so it begins finer, with a probe.
    const Segment& begin(std::uint32_t room, bool eventful);
    /// `unpredictable` frames are kept, though the motion's error is above its limit, since more substeps do not reduce
    /// it: the cloth crumples, and neighbouring motions part whatever is done.
    enum class Verdict { keep, unpredictable, again, give_up };
    /// Judges the attempt that `segment` says; `again` asks for what `segment` says now.
    Verdict judge(const Judgement& judgement);
    /// Returns whether what an attempt's frames so far show lets it fail, so that the others need not be run.
    bool fails(const Judgement& judgement) const {
        return (judgement.excess() > 1 && !at_top()) || passes(judgement) || lags(judgement);
    }
    const Segment& segment() const { return segment_; }
    bool at_top() const { return tried_ + 1 == rungs_.size(); }
    /// Keeps the frames although the last judgement says no.
    void keep_anyway();
    /// Tells how much of what its limit allows the motion's error has come to since the start, after a segment is kept
    /// (control/motion_error.h); 0 where that is the motion's own doing. Far from the limit there are fewer probes, and
    /// methods that have none take more substeps near it. `unknown_share` is neither far nor near.
    void accumulated(double share);

    /// Hands everything that changes, between segments, to `archive(members...)`, which writes or reads it
    /// (byte_stream.h). Returns whether what was read can be.
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
    bool resolves_;  ///< no probe is needed
    std::uint32_t probe_length_;
    std::size_t lowest_, proposed_;
    std::size_t rung_;       ///< the rung of frames to come
    std::size_t began_ = 0;  ///< the rung before the segment
    std::size_t tried_ = 0;  ///< the rung of the attempt
    double order_ = 2;       ///< power with which the motion's error falls
    double slack_ = 1;       ///< factor on the motion's limit, where more substeps did not help
    struct Tried {
        double substeps = 0, motion = 0;
    } before_,               ///< a failed attempt of the segment, to tell whether more substeps help
        probed_;             ///< the last probe
    double top_motion_ = 0;  ///< the error at the top, while a quarter of its substeps is tried
    bool hopeless_ = false;  ///< that one was worse: more substeps would help, and there are none
    /// The finest attempt at the segment so far that only its motion let fail.
    std::optional<std::size_t> only_motion_failed_;
    bool turned_back_ = false;  ///< it went back to an earlier one
    std::size_t needed_ = 0;    ///< the least rung that the segment's stretch may take
    double share_ = 0;          ///< of the allowed error that there is
    /// The rung that the ways and lags of the last attempt ask for. It holds for frames while something goes by a
    /// collider fast, or meets fast, and those after have `rung_` again.
    std::size_t passage_rung_ = 0;
    struct Lagged {
        double substeps = 0, lag = 0;
    } lagged_;                     ///< the segment's first attempt whose lag was above its limit
    std::uint32_t until_lag_ = 0;  ///< frames before lags are looked at again, since more substeps did not lessen one
    Segment segment_{};
    std::uint32_t interval_ = 1, until_probe_ = 0;  ///< frames between probes, before the next
    std::uint32_t since_fewer_ = 1000000;           ///< frames since the substeps went down
    std::uint32_t patience_ = 1, easy_ = 0;         ///< easy probes before they go down, so far
};

}  // namespace drape
