// Uncompressed video for a file or a pipe is YUV4MPEG2 (https://wiki.multimedia.cx/index.php/YUV4MPEG2), which says its
// own size and rate, or bare pixels.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "output/frame_writer.h"

namespace drape {

namespace {

struct Rate {
    std::uint64_t numerator, denominator;
};

/// Returns the written frames per second: whole ones, the 1001ths of television, or to a millionth.
Rate rate_of(const WrittenRun& run) {
    Rate rate{0, 1'000'000};
    for (const std::uint64_t denominator : {1001u, 1u}) {
        const double frames = run.fps * static_cast<double>(denominator);
        if (std::abs(frames - std::round(frames)) < 1e-9 * frames) rate.denominator = denominator;
    }
    rate.numerator = static_cast<std::uint64_t>(std::llround(run.fps * static_cast<double>(rate.denominator)));
    rate.denominator *= run.step;
    const std::uint64_t common = std::gcd(rate.numerator, rate.denominator);
    return {rate.numerator / common, rate.denominator / common};
}

/// An sRGB colour as Y'CbCr of BT.709, limited range, in 65536ths: Kr = 0.2126, Kb = 0.0722.
struct LumaChroma {
    std::int64_t y, cb, cr;
};

LumaChroma luma_chroma(const std::uint8_t* rgb) {
    const std::int64_t r = rgb[0], g = rgb[1], b = rgb[2];
    // The factors hold 219/255 of the luma, and 224/255 of (b - y)/1.8556 and (r - y)/1.5748.
    return {11966 * r + 40254 * g + 4064 * b, -6596 * r - 22189 * g + 28785 * b, 28784 * r - 26145 * g - 2639 * b};
}

std::uint8_t rounded(std::int64_t value, std::int64_t scale, std::int64_t offset) {
    const std::int64_t shifted = value + offset * scale + scale / 2;
    return static_cast<std::uint8_t>(std::clamp<std::int64_t>(shifted / scale, 0, 255));
}

/// Makes 4:2:0 with the chroma between its four pixels. Odd sides get their last pixels twice, because encoders take
/// even ones only.
std::string y4m_frame(std::span<const std::uint8_t> rgba, std::uint32_t width, std::uint32_t height) {
    const std::uint32_t even_width = (width + 1) / 2 * 2, even_height = (height + 1) / 2 * 2;
    std::string luma, cb, cr;
    luma.resize(std::size_t{even_width} * even_height);
    for (std::uint32_t row = 0; row < even_height; row += 2)
        for (std::uint32_t column = 0; column < even_width; column += 2) {
            LumaChroma sum{0, 0, 0};
            for (std::uint32_t k = 0; k < 4; ++k) {
                const std::uint32_t y = row + k / 2, x = column + k % 2;
                const std::size_t from = std::size_t{std::min(y, height - 1)} * width + std::min(x, width - 1);
                const LumaChroma pixel = luma_chroma(&rgba[4 * from]);
                luma[std::size_t{y} * even_width + x] = static_cast<char>(rounded(pixel.y, 65536, 16));
                sum.cb += pixel.cb;
                sum.cr += pixel.cr;
            }
            cb += static_cast<char>(rounded(sum.cb, 4 * 65536, 128));
            cr += static_cast<char>(rounded(sum.cr, 4 * 65536, 128));
        }
    return "FRAME\n" + luma + cb + cr;
}

std::string y4m_header(const WrittenRun& run) {
    const Rate rate = rate_of(run);
    return fmt::format("YUV4MPEG2 W{} H{} F{}:{} Ip A1:1 C420jpeg XCOLORRANGE=LIMITED\n", (run.width + 1) / 2 * 2,
                       (run.height + 1) / 2 * 2, rate.numerator, rate.denominator);
}

std::string rgb_frame(std::span<const std::uint8_t> rgba, std::uint32_t width, std::uint32_t height) {
    std::string text;
    text.reserve(std::size_t{width} * height * 3);
    for (std::size_t i = 0; i + 3 < rgba.size(); i += 4) text.append(reinterpret_cast<const char*>(&rgba[i]), 3);
    return text;
}

std::string no_header(const WrittenRun&) { return {}; }

/// A kind of video has its own beginning, and its own form of a picture.
struct VideoKind {
    std::string_view file_name;
    std::string (*header)(const WrittenRun&);
    std::string (*frame)(std::span<const std::uint8_t> rgba, std::uint32_t width, std::uint32_t height);
};
constexpr VideoKind y4m{"video.y4m", y4m_header, y4m_frame}, rgb{"video.rgb", no_header, rgb_frame};

class Video : public FrameWriter {
  public:
    Video(const VideoKind& kind, const WrittenRun& run, ByteSink sink)
        : kind_(kind), width_(run.width), height_(run.height), sink_(std::move(sink)) {
        sink_(bytes_of(kind.header(run)));
    }
    Video(const VideoKind& kind, const WrittenRun& run, std::unique_ptr<AtomicFile> file)
        : Video(kind, run, [into = file.get()](std::span<const std::byte> bytes) { into->append(bytes); }) {
        file_ = std::move(file);
    }

    void add(const WrittenFrame& frame) override { sink_(bytes_of(kind_.frame(frame.rgba, width_, height_))); }

    std::vector<FileRecord> finish() override {
        return file_ ? std::vector{file_->commit()} : std::vector<FileRecord>{};
    }

  private:
    const VideoKind& kind_;
    std::uint32_t width_, height_;
    ByteSink sink_;
    std::unique_ptr<AtomicFile> file_;
};

template <const VideoKind& kind>
std::unique_ptr<FrameWriter> open_file(OutputFolder& folder, const WrittenRun& run) {
    return std::make_unique<Video>(kind, run, std::make_unique<AtomicFile>(folder, std::string(kind.file_name)));
}

template <const VideoKind& kind>
std::unique_ptr<FrameWriter> open_stream(const ByteSink& sink, const WrittenRun& run) {
    return std::make_unique<Video>(kind, run, sink);
}

}  // namespace

extern const OutputFormat y4m_format{
    .name = "y4m",
    .files = "video.y4m",
    .holds =
        "uncompressed video, 4:2:0, BT.709, limited range, of even size (odd sides get their last pixels twice); "
        "with -o - on stdout",
    .draws = true,
    .frame_files = false,
    .frame_bytes = [](const FrameSize& frame) { return frame.pixels * 3 / 2; },
    .owns = [](std::string_view name) { return name == y4m.file_name; },
    .open = open_file<y4m>,
    .stream = open_stream<y4m>};

extern const OutputFormat rgb_format{
    .name = "rgb",
    .files = "video.rgb",
    .holds = "bare pixels, 3 bytes each, sRGB, rows from the top, frame after frame; with -o - on stdout",
    .draws = true,
    .frame_files = false,
    .frame_bytes = [](const FrameSize& frame) { return frame.pixels * 3; },
    .owns = [](std::string_view name) { return name == rgb.file_name; },
    .open = open_file<rgb>,
    .stream = open_stream<rgb>};

}  // namespace drape
