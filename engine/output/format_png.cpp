#include <algorithm>
#include <thread>

#include "output/frame_writer.h"
#include "output/png_sequence.h"

namespace drape {

namespace {

class PngWriter : public FrameWriter {
  public:
    PngWriter(OutputFolder& folder, const WrittenRun& run)
        : width_(run.width),
          height_(run.height),
          sequence_(folder, frame_digits(run.end), std::clamp(std::thread::hardware_concurrency(), 1u, 4u), run.key,
                    run.alpha ? PngAlpha::kept : PngAlpha::dropped) {}

    void add(const WrittenFrame& frame) override {
        std::vector<std::uint8_t> rgba = sequence_.take_buffer(frame.rgba.size());
        std::ranges::copy(frame.rgba, rgba.begin());
        FrameValues values = frame.values;
        std::erase_if(values, [](const auto& each) { return is_given(each.first); });
        sequence_.submit(frame.number, width_, height_, std::move(rgba), values);
    }

    void flush() override { sequence_.flush(); }
    std::vector<FileRecord> finish() override { return sequence_.finish(); }

  private:
    std::uint32_t width_, height_;
    PngSequence sequence_;
};

}  // namespace

extern const OutputFormat png_format{.name = "png",
                                     .files = "frame_FRAME.png",
                                     .holds = "the pictures, 8-bit sRGB",
                                     .draws = true,
                                     .resumes = true,
                                     .frame_files = true,
                                     .owns = is_frame_file_name,
                                     .open = open_writer<PngWriter>};

}  // namespace drape
