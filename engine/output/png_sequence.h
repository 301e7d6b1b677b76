#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "output/frame_writer.h"
#include "output/png.h"

namespace drape {

// Returns "frame_0001.png".
std::string frame_file_name(std::uint64_t frame, int digits);
bool is_frame_file_name(std::string_view name);

// Writes frames as PNG files on worker threads while the caller computes the next ones. Which thread writes a frame
// changes no byte of it.
// The caller's side (take_buffer, submit, finish) is for one thread. A failure in a worker is thrown, as it was, by the
// next submit() or by finish(); frames still waiting are then dropped, finished files stay. Destruction without
// finish() drops the frames that no worker has begun.
class PngSequence {
  public:
    // A worker_count of 0 means 1. The folder must outlive the sequence. `run_key`, unless empty, goes into every file
    // (kept_frames.h), so that a later run can tell whose frames these are.
    PngSequence(OutputFolder& folder, int digits, unsigned worker_count, std::string run_key = {},
                PngAlpha alpha = PngAlpha::dropped);

    // Returns a buffer of so many bytes with arbitrary content, recycled from a written frame when there is one.
    std::vector<std::uint8_t> take_buffer(size_t bytes);

    // Queues a frame: RGBA8, rows tightly packed from the top. Waits while two frames per worker are queued or being
    // written, so memory is bounded. `values` go into the file beside the run key. Throws a worker's error, or
    // std::invalid_argument when the sizes do not fit.
    void submit(std::uint64_t frame, std::uint32_t width, std::uint32_t height, std::vector<std::uint8_t> rgba,
                FrameValues values = {});

    // Waits for all frames. Throws a worker's error.
    void flush();

    // Waits for all frames and returns the files written, by name. Throws a worker's error. Nothing may be submitted
    // after.
    std::vector<FileRecord> finish();

  private:
    struct Frame {
        std::uint64_t number = 0;
        std::uint32_t width = 0;
        std::uint32_t height = 0;
        std::vector<std::uint8_t> rgba;
        FrameValues values;
    };
    struct Progress {
        std::deque<Frame> queue;
        size_t pending_count = 0;  // queued or being written
        bool finished = false;
        std::exception_ptr error;
    };

    void work(const std::stop_token& stop);
    FileRecord write(const Frame& frame, std::vector<std::uint8_t>& png);
    void keep_result(FileRecord record, std::vector<std::uint8_t> buffer);

    OutputFolder& folder_;
    int digits_;
    size_t pending_limit_;
    std::string run_key_;
    PngAlpha alpha_;

    std::mutex mutex_;
    std::condition_variable_any frame_waits_;
    std::condition_variable_any frame_done_;
    Progress progress_;
    std::vector<std::vector<std::uint8_t>> free_buffers_;
    std::vector<FileRecord> records_;

    std::vector<std::jthread> workers_;  // last, as they are stopped and joined before anything they use goes
};

}  // namespace drape
