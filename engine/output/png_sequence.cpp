#include "output/png_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "output/png.h"

namespace drape {

std::string frame_file_name(std::uint64_t frame, int digits) {
    return cloth_frame_file_name("frame", WrittenCloth{}, frame, digits, "png");
}

bool is_frame_file_name(std::string_view name) {
    // A picture shows all cloths, so its name has no cloth's.
    return is_cloth_frame_file_name(name, "frame", "png") && name.find('_') == name.rfind('_');
}

PngSequence::PngSequence(OutputFolder& folder, int digits, unsigned worker_count, std::string run_key, PngAlpha alpha)
    : folder_(folder),
      digits_(digits),
      pending_limit_(2 * std::max(1u, worker_count)),
      run_key_(std::move(run_key)),
      alpha_(alpha) {
    for (unsigned worker = 0; worker < std::max(1u, worker_count); ++worker) {
        workers_.emplace_back([this](const std::stop_token& stop) { work(stop); });
    }
}

std::vector<std::uint8_t> PngSequence::take_buffer(size_t bytes) {
    std::vector<std::uint8_t> buffer;
    {
        const std::scoped_lock lock(mutex_);
        if (!free_buffers_.empty()) {
            buffer = std::move(free_buffers_.back());
            free_buffers_.pop_back();
        }
    }
    buffer.resize(bytes);
    return buffer;
}

void PngSequence::submit(std::uint64_t frame, std::uint32_t width, std::uint32_t height, std::vector<std::uint8_t> rgba,
                         FrameValues values) {
    if (rgba.size() != size_t{width} * height * 4 || rgba.empty()) {
        throw std::invalid_argument(
            fmt::format("frame {}: {} bytes are not {}x{} RGBA pixels", frame, rgba.size(), width, height));
    }
    std::unique_lock lock(mutex_);
    if (progress_.finished) throw std::logic_error(fmt::format("frame {} submitted after finish()", frame));
    frame_done_.wait(lock, [this] { return progress_.pending_count < pending_limit_ || progress_.error; });
    if (progress_.error) std::rethrow_exception(progress_.error);
    progress_.queue.push_back({frame, width, height, std::move(rgba), std::move(values)});
    ++progress_.pending_count;
    frame_waits_.notify_one();
}

void PngSequence::flush() {
    std::unique_lock lock(mutex_);
    frame_done_.wait(lock, [this] { return progress_.pending_count == 0; });
    if (progress_.error) std::rethrow_exception(progress_.error);
}

std::vector<FileRecord> PngSequence::finish() {
    flush();
    const std::scoped_lock lock(mutex_);
    progress_.finished = true;
    std::ranges::sort(records_, {}, &FileRecord::name);
    return records_;
}

void PngSequence::work(const std::stop_token& stop) {
    std::vector<std::uint8_t> png;
    std::unique_lock lock(mutex_);
    while (frame_waits_.wait(lock, stop, [this] { return !progress_.queue.empty(); }) && !stop.stop_requested()) {
        Frame frame = std::move(progress_.queue.front());
        progress_.queue.pop_front();
        lock.unlock();
        std::exception_ptr error;
        FileRecord record;
        try {
            record = write(frame, png);
        } catch (...) {
            error = std::current_exception();
        }
        lock.lock();
        try {
            if (!error) keep_result(std::move(record), std::move(frame.rgba));
        } catch (...) {
            error = std::current_exception();
        }
        --progress_.pending_count;
        if (error && !progress_.error) progress_.error = error;
        if (progress_.error) {
            progress_.pending_count -= progress_.queue.size();
            progress_.queue.clear();
        }
        frame_done_.notify_all();
    }
}

void PngSequence::keep_result(FileRecord record, std::vector<std::uint8_t> buffer) {
    records_.push_back(std::move(record));
    free_buffers_.push_back(std::move(buffer));
}

FileRecord PngSequence::write(const Frame& frame, std::vector<std::uint8_t>& png) {
    const std::string text = run_key_.empty() ? std::string() : frame_text(run_key_, frame.number, frame.values);
    encode_png(frame.width, frame.height, frame.rgba, png, text, alpha_);
    return write_file(folder_, frame_file_name(frame.number, digits_), std::as_bytes(std::span(png)));
}

}  // namespace drape
