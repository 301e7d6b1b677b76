#include "simulation/member_run.h"

#include <fmt/format.h>

#include "simulation/contact_report.h"
#include "simulation/frame_checks.h"
#include "vulkan/error.h"
#include "world/frame_limit.h"

namespace drape {

MemberRun::MemberRun(const SimulationModel& model, const RunListener& listener)
    : model_(model), listener_(listener), pilot_(make_pilot(model)), self_contact_(starting_report(model)) {}

void MemberRun::ask(const FrameRequest& request) {
    request_ = request;
    over_ = complete_ = forgets_ = false;
}

bool MemberRun::can_save() const {
    // A closed loop that is stopped within frames forgets them. Frame 0 is there before any is simulated.
    return begun_ || (waiting_.withheld.empty() && std::max(next_frame_, 1u) >= pilot_->simulated());
}

bool MemberRun::cutters_active_in(std::uint32_t frame) const {
    const double fps = model_.scene.time.fps;
    return cutters_active(model_.scene.cutters, frame == 0 ? 0 : (frame - 1) / fps, frame / fps);
}

bool MemberRun::searched(std::uint32_t frame) const {
    return (frame > 0 && model_.scene.tears()) || cutters_active_in(frame);
}

std::optional<Job> MemberRun::next_job() {
    if (over_ || jobs_.unfinished > 0) return std::nullopt;
    for (;;) {
        if (begun_) {
            if (const auto& refusal = pilot_->refusal(); refusal && listener_.keep_promises) raise(*refusal);
            std::optional<Work> work = pilot_->next_work();
            if (!work) {
                end_frames();
                continue;
            }
            if (work->attempt > 0 && stopped()) {
                pilot_->abandon(*work);
                waiting_.withheld.clear();
                begun_ = false;
                over_ = forgets_ = true;
                work = pilot_->next_work();
                if (!work) return std::nullopt;
            }
            if (std::optional<Job> job = job_of(std::move(*work))) return job;
            continue;
        }
        if (next_frame_ > request_.last) {
            complete_ = over_ = true;
            return std::nullopt;
        }
        const bool is_start = next_frame_ == 0;
        // The initial state already exists, so frame 0 needs no job that nobody wants.
        if (is_start && !request_.wanted(0) && !searched(0) && !listener_.on_passed_over) {
            ++next_frame_;
            continue;
        }
        if (stopped()) {
            over_ = true;
            return std::nullopt;
        }
        if (is_start) return first_job();
        if (next_frame_ < pilot_->simulated()) {
            release_withheld();
            continue;
        }
        if (listener_.on_begin) listener_.on_begin(pilot_->simulated());
        pilot_->begin();
        begun_ = true;
    }
}

std::optional<Job> MemberRun::first_job() {
    Job job{.work = {.substeps = pilot_->state_substeps(), .hands_out = true},
            .wanted = request_.wanted(0),
            .searches = searched(0)};
    if (job.searches || listener_.on_begin) job.until = Job::Until::delivered;
    ++next_frame_;
    ++jobs_.undelivered;
    jobs_.unfinished += job.until != Job::Until::submitted;
    return job;
}

/// Returns the job for a piece of work; nothing: the work needs no device.
std::optional<Job> MemberRun::job_of(Work work) {
    Job job{.work = std::move(work)};
    Work& own = job.work;
    const bool is_known = own.known.has_value();
    // Frames after the last requested one may be requested later. For a sleeping frame the last search is still valid.
    if (own.hands_out) {
        job.wanted = (is_known && own.frame > request_.last) || request_.wanted(own.frame);
        job.searches = !(is_known && own.known->effort.asleep) && searched(own.frame);
    }
    own.hands_out = job.wanted;
    if (is_known && !job.wanted && !job.searches) return std::nullopt;
    if (own.attempt > 0 && listener_.on_attempt) listener_.on_attempt({own.frame, own.substeps, own.attempt});
    if (own.attempt > 0 && own.before) waiting_.withheld.clear();  // another attempt begins
    const bool ends_probe = is_known && own.known->withheld && own.frame + 1 == pilot_->simulated();
    if (job.searches || ends_probe || listener_.on_begin)
        job.until = Job::Until::delivered;
    else if (own.awaited || (own.simulates && model_.self_contact))
        job.until = Job::Until::settled;
    ++jobs_.undelivered;
    jobs_.unfinished += job.until != Job::Until::submitted;
    return job;
}

void MemberRun::attempt_anew(const Job& job) {
    --jobs_.undelivered;
    jobs_.unfinished -= job.until != Job::Until::submitted;
    waiting_.withheld.clear();
    pilot_->attempt_anew();
}

FrameEffort MemberRun::settle(const Job& job, const WorkResult& result) {
    const Work& work = job.work;
    const FrameEffort effort = pilot_->take(work, result);
    if (work.simulates && work.set == StateSet::run && work.attempt == 0)
        note_contact(work.frame, result.contact, result.list_use);
    if (job.until == Job::Until::settled) --jobs_.unfinished;
    return effort;
}

void MemberRun::deliver(const Job& job, const FinishedFrame& frame) {
    --jobs_.undelivered;
    if (job.until == Job::Until::delivered) --jobs_.unfinished;
    const Work& work = job.work;
    if (job.wanted && work.known && work.known->withheld) {
        if (!forgets_) waiting_.withheld.emplace_back().keep(frame);
        return;
    }
    if (job.wanted) return give(frame);
    // A frame of a closed loop is reported when it is kept.
    const bool is_told = work.frame == 0 || (work.simulates && work.set == StateSet::run && work.attempt == 0);
    if (is_told && listener_.on_passed_over) listener_.on_passed_over(frame);
}

/// Ends the frames that the pilot had begun, all of which are done.
void MemberRun::end_frames() {
    begun_ = false;
    if (const KeptFrames* const kept = pilot_->kept()) {
        const std::uint32_t end = pilot_->simulated();
        for (std::uint32_t frame = kept->first; frame < end; ++frame) {
            const std::size_t k = frame - kept->first;
            if (k < kept->contacts.size()) note_contact(frame, kept->contacts[k], kept->list_use);
            // Frames after the last requested one are withheld.
            if (frame <= request_.last && !request_.wanted(frame)) pass_over(frame, kept->statistics[k], kept->effort);
        }
        for (FrameCopy& copy : waiting_.withheld) copy.effort() = kept->effort;
        return release_withheld();
    }
    ++next_frame_;
}

/// Adds a frame's contact record to the report.
void MemberRun::note_contact(std::uint32_t frame, const glsl::SelfRecord& record, double list_use) {
    if (!self_contact_) return;
    if (list_use > 1)
        throw vulkan::VulkanError(fmt::format(
            "cloth meets {} in more places than a buffer of the device can list: frame {} has {:.3g} times as many "
            "pairs of triangles and edges near each other; more substeps or a smaller "
            "self_collision.thickness make them fewer",
            model_.cloths.size() > 1 ? "itself or another" : "itself", frame, list_use));
    drape::note_contact(*self_contact_, model_, frame, record);
}

void MemberRun::give(const FinishedFrame& frame) {
    tell_passed_over(frame.frame);
    request_.finished(frame);
}

/// Hands out the next of the frames that were simulated earlier.
void MemberRun::release_withheld() {
    const std::uint32_t frame = next_frame_++;
    if (!waiting_.withheld.empty() && waiting_.withheld.front().frame().frame == frame) {
        const FrameCopy copy = std::move(waiting_.withheld.front());
        waiting_.withheld.pop_front();
        if (request_.wanted(frame))
            give(copy.frame());
        else
            pass_over(frame, copy.frame().statistics, copy.frame().effort);
    }
    if (jobs_.undelivered == 0) tell_passed_over(frame + 1);
}

void MemberRun::pass_over(std::uint32_t frame, const std::vector<ClothStatistics>& statistics,
                          const FrameEffort& effort) {
    if (!listener_.on_passed_over) return;
    FinishedFrame& passed = waiting_.passed_over.emplace_back();
    passed.frame = frame;
    passed.statistics = statistics;
    passed.effort = effort;
}

void MemberRun::tell_passed_over(std::uint32_t end) {
    while (!waiting_.passed_over.empty() && waiting_.passed_over.front().frame < end) {
        const FinishedFrame frame = std::move(waiting_.passed_over.front());
        waiting_.passed_over.pop_front();
        listener_.on_passed_over(frame);
    }
}

void MemberRun::conclude() { tell_passed_over(next_frame_); }

void MemberRun::write(ByteWriter& writer) const {
    writer(next_frame_);
    if (self_contact_) transfer_report(writer, const_cast<SelfContactReport&>(*self_contact_));
    pilot_->write(writer);
}

void MemberRun::read(ByteReader& reader) {
    waiting_.withheld.clear();  // a probe's, of the motion that is left
    waiting_.passed_over.clear();
    reader(next_frame_);
    if (self_contact_) transfer_report(reader, *self_contact_);
    pilot_->read(reader);
    // A run may go beyond its scene's frames, but not beyond the frames that any scene can have.
    const std::uint32_t most = std::max(scene_frame_limit, model_.scene.time.frame_count);
    if (std::max(next_frame_, pilot_->simulated()) > most || reader.left() > 0 || !can_save())
        throw Error("its part 'loop' is of something else");
}

}  // namespace drape
