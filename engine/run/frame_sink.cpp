#include "run/frame_sink.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "run/contacts.h"
#include "run/given_values.h"
#include "world/body_pose.h"

namespace drape {

namespace {

constexpr const char* whole_frame = "frame";  // a column beside the stages, none of which has this name

}  // namespace

std::vector<const OutputFormat*> output_formats(const std::vector<std::string>& names) {
    std::vector<const OutputFormat*> formats;
    for (const std::string& name : names) {
        const OutputFormat* format = find_output_format(name);
        if (!format) throw UsageError(fmt::format("there is no output format '{}'", name));
        if (std::ranges::find(formats, format) == formats.end()) formats.push_back(format);
    }
    return formats;
}

Sink::Sink(std::optional<OutputFolder>& folder, const RunRequest& request, const SceneDescription& scene,
           const WrittenRun& run, const std::map<std::uint32_t, KeptFrame>& kept, Journal* journal)
    : scene_(scene),
      kept_(kept),
      journal_(journal),
      bodies_(run.bodies),
      details_(request.details()),
      statistics_(std::make_shared<RunStatistics>(folder ? &*folder : nullptr)) {
    if (folder) times_.emplace(*folder);
    for (const OutputFormat* format : output_formats(request.formats))
        writers_.push_back({format, folder ? format->open(*folder, run) : format->stream(request.stream, run)});
    for (const auto& [frame, picture] : kept) {
        FrameValues values = given_values(scene, frame);
        values.insert(picture.values.begin(), picture.values.end());
        statistics_->add(frame, values);
    }
}

Sink::Contacts Sink::touched(std::uint32_t frame, const std::vector<std::span<const float>>& positions) const {
    Contacts all;
    if (!details_) return all;
    const std::vector<Collider> colliders = placed(scene_.colliders, bodies_->at(frame));
    for (std::size_t cloth = 0; cloth < positions.size(); ++cloth)
        all.push_back(touched_colliders(scene_.cloths[cloth], colliders, frame / scene_.time.fps, positions[cloth]));
    return all;
}

void Sink::write(const WrittenFrame& frame) {
    if (!kept_.contains(frame.number)) statistics_->add(frame.number, frame.values);
    latest_ = frame.values;
    for (const Writer& writer : writers_)
        if (!writer.format->resumes || !kept_.contains(frame.number)) writer.files->add(frame);
}

void Sink::add(const FinishedFrame& frame) {
    (*bodies_)[frame.frame] = frame.bodies;
    const Contacts contacts = touched(frame.frame, frame.positions);
    const WrittenFrame written{frame.frame,
                               frame.rgba,
                               frame.positions,
                               frame.velocities,
                               {contacts.begin(), contacts.end()},
                               frame_values(scene_, frame),
                               frame.layers,
                               frame.tensions,
                               frame.contact_forces};
    write(written);
    if (journal_) {
        JournalRecord record{.frame = frame.frame, .values = written.values};
        const auto copy = [](const std::vector<std::span<const float>>& from, std::vector<std::vector<float>>& to) {
            for (const auto& cloth : from) to.emplace_back(cloth.begin(), cloth.end());
        };
        copy(frame.positions, record.positions), copy(frame.velocities, record.velocities);
        copy(frame.tensions, record.tensions), copy(frame.contact_forces, record.contact_forces);
        journal_->add(record);
    }
    const auto now = std::chrono::steady_clock::now();
    FrameValues times{{whole_frame, std::chrono::duration<double, std::milli>(now - last_).count()}};
    last_ = now;
    for (const StageTime& timing : frame.timings) times[timing.name] = timing.milliseconds;
    if (times_) times_->add(frame.frame, times);
}

void Sink::repeat(const JournalRecord& frame) {
    WrittenFrame written{frame.frame, {}, {}, {}, {}, frame.values};
    for (const auto& cloth : frame.positions) written.positions.emplace_back(cloth);
    for (const auto& cloth : frame.velocities) written.velocities.emplace_back(cloth);
    for (const auto& cloth : frame.tensions) written.tensions.emplace_back(cloth);
    for (const auto& cloth : frame.contact_forces) written.contact_forces.emplace_back(cloth);
    (*bodies_)[frame.frame] = bodies_of(scene_, frame.values);
    const Contacts contacts = touched(frame.frame, written.positions);
    for (const auto& cloth : contacts) written.contacts.emplace_back(cloth);
    write(written);
}

void Sink::add_cut(const Cut& cut) {
    const JournalRecord record{.kind = JournalRecord::Kind::cut,
                               .frame = cut.frame,
                               .cloth = static_cast<std::uint32_t>(cut.cloth),
                               .springs = cut.springs,
                               .torn = cut.torn,
                               .triangles = cut.triangles,
                               .pieces = cut.pieces,
                               .crumbs = cut.crumbs,
                               .faces = cut.faces,
                               .spring_bits = cut.spring_bits};
    if (journal_) journal_->add(record);
    repeat_cut(record);
}

void Sink::repeat_cut(const JournalRecord& cut) {
    cuts_.push_back(
        {cut.frame, scene_.cloths.at(cut.cloth).name, cut.springs, cut.torn, cut.triangles, cut.pieces, cut.crumbs});
    for (const Writer& writer : writers_) {
        writer.files->set_faces(cut.frame + 1, cut.cloth, cut.faces);
        writer.files->set_springs(cut.frame + 1, cut.cloth, cut.spring_bits);
    }
}

void Sink::flush() {
    for (const Writer& writer : writers_) writer.files->flush();
}

std::vector<FileRecord> Sink::finish(bool complete, std::vector<std::string>& dropped) {
    std::vector<FileRecord> files;
    for (const Writer& writer : writers_) {
        if (complete || writer.format->frame_files)
            std::ranges::move(writer.files->finish(), std::back_inserter(files));
        else
            dropped.emplace_back(writer.format->name);
    }
    for (const auto& [frame, picture] : kept_) files.push_back(picture.file);
    std::ranges::sort(files, {}, &FileRecord::name);
    return files;
}

void Sink::add_timings(Manifest& manifest) const {
    if (!times_) return;
    for (const std::string& name : times_->names()) {
        std::vector<double> known = times_->column(name);
        std::erase_if(known, [](double time) { return std::isnan(time); });
        const auto summary = summarize_frame_times(known);
        if (name == whole_frame)
            manifest.frame_time = summary;
        else if (summary)
            manifest.stage_median_ms[name] = summary->median;
    }
}

}  // namespace drape
