// A run tells this of its motion in the end: the worst frame of its position error, frames that were kept over
// their limit, and from where on equally exact runs part.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cloth/simulation_model.h"
#include "drape/frame.h"

namespace drape {

class MotionWatch {
  public:
    /// A frame's estimated position error, what is excused of it since equally exact runs had parted so far, and what
    /// is allowed, m.
    struct Position {
        std::uint32_t frame = 0;
        double error = 0, excused = 0, allowed = 0;
        double share() const { return (error - excused) / allowed; }
    };
    /// The first sensitive frame, with how far equally exact runs had parted and the estimated error, m.
    struct Parting {
        std::uint32_t frame = 0;
        double parted = 0, error = 0;
        /// Returns whether the run stands on a point: runs leave it that differ by far less than its error.
        bool stands_on_a_point() const;
    };

    explicit MotionWatch(const SimulationModel& model) : promises_(model.closed_loop()) {}

    /// Frames come in order.
    void look(std::uint32_t frame, const FrameEffort& effort);

    /// Returns the frame in which the position error was the largest share of what is allowed; nothing: none was
    /// stated.
    const std::optional<Position>& worst() const { return worst_; }
    const std::optional<Parting>& parting() const { return parting_; }
    /// Returns the warnings, of which there are none where no limits are promised.
    std::vector<std::string> warnings() const;
    /// Returns the note that from some frame on no positions are right.
    std::optional<std::string> note() const;

    /// Writes or reads what it remembers of earlier frames, by a ByteWriter or a ByteReader.
    template <class Archive>
    bool transfer(Archive& archive) {
        bool stated = worst_.has_value(), parts = parting_.has_value();
        archive(stated, parts, over_, hasty_.frames, hasty_.worst, hasty_.times);
        if (stated != worst_.has_value()) worst_ = stated ? std::optional(Position{}) : std::nullopt;
        if (parts != parting_.has_value()) parting_ = parts ? std::optional(Parting{}) : std::nullopt;
        if (stated) archive(worst_->frame, worst_->error, worst_->excused, worst_->allowed);
        if (parts) archive(parting_->frame, parting_->parted, parting_->error);
        return true;
    }

  private:
    bool promises_;  ///< the run keeps limits, or says that it does not
    std::optional<Position> worst_;
    std::optional<Parting> parting_;
    std::uint32_t over_ = 0;  ///< number of frames whose position error is not allowed
    struct Hasty {
        std::uint32_t frames = 0, worst = 0;
        double times = 0;  ///< the error of the motion in the worst frame, divided by its limit
    } hasty_;              ///< frames that were kept though their motion's error is over its limit
};

}  // namespace drape
