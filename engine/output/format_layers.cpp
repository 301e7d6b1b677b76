// Layers of pictures (LayerPixel): a file for each frame and layer, of numbers, or 16-bit PNG.
#include <algorithm>
#include <cmath>

#include "output/frame_writer.h"
#include "output/npy.h"
#include "output/png.h"

namespace drape {

namespace {

/// It says how the files of a layer are called, and what they have of each pixel.
struct Layer {
    std::string_view name;
    const char* type;              ///< of a NumPy array
    std::uint32_t components = 1;  ///< of it and of a PNG
    void (*append)(const LayerPixel& pixel, std::string& bytes);
    void (*append16)(const LayerPixel& pixel, std::vector<std::uint16_t>& values);
};

template <class Value>
void append_value(std::string& bytes, Value value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Returns steps of a size from an origin, as 1 .. 65535: 0 is left for where there is nothing.
std::uint16_t layer_steps(double value, double step, double origin) {
    return static_cast<std::uint16_t>(std::clamp(std::round(value / step + origin), 1.0, 65535.0));
}

constexpr Layer depth_layer{
    "depth", "<f4", 1, [](const LayerPixel& pixel, std::string& bytes) { append_value(bytes, pixel.depth); },
    [](const LayerPixel& pixel, std::vector<std::uint16_t>& values) {
        values.push_back(pixel.id == 0 ? std::uint16_t{0} : layer_steps(static_cast<double>(pixel.depth), 1e-3, 0));
    }};
constexpr Layer normal_layer{"normal", "<f4", 3,
                             [](const LayerPixel& pixel, std::string& bytes) {
                                 for (const std::int16_t part : pixel.normal)
                                     append_value(bytes, static_cast<float>(part) / 32767);
                             },
                             [](const LayerPixel& pixel, std::vector<std::uint16_t>& values) {
                                 for (const std::int16_t part : pixel.normal)
                                     values.push_back(static_cast<std::uint16_t>(pixel.id == 0 ? 0 : 32768 + part));
                             }};
constexpr Layer id_layer{
    "id", "<u2", 1, [](const LayerPixel& pixel, std::string& bytes) { append_value(bytes, pixel.id); },
    [](const LayerPixel& pixel, std::vector<std::uint16_t>& values) { values.push_back(pixel.id); }};
constexpr Layer strain_layer{
    "strain", "<f4", 1, [](const LayerPixel& pixel, std::string& bytes) { append_value(bytes, pixel.strain); },
    [](const LayerPixel& pixel, std::vector<std::uint16_t>& values) {
        values.push_back(pixel.id == 0 ? std::uint16_t{0}
                                       : layer_steps(static_cast<double>(pixel.strain), 1e-4, 32768));
    }};

std::string layer_file_name(const Layer& layer, std::uint64_t frame, int digits, std::string_view extension) {
    return cloth_frame_file_name(layer.name, {}, frame, digits, extension);
}

bool is_layer_file_name(const Layer& layer, std::string_view name, std::string_view extension) {
    return is_cloth_frame_file_name(name, layer.name, extension) &&
           std::ranges::count(name, '_') == 1;  // no cloth's name stands between
}

template <const Layer& layer, bool is_picture>
class LayerFiles : public FrameWriter {
  public:
    LayerFiles(OutputFolder& folder, const WrittenRun& run)
        : folder_(folder), width_(run.width), height_(run.height), digits_(frame_digits(run.end)) {}

    void add(const WrittenFrame& frame) override {
        const std::string name = layer_file_name(layer, frame.number, digits_, is_picture ? "png" : "npy");
        if constexpr (is_picture) {
            const std::vector<std::uint8_t> png = png_of(frame.layers);
            files_.push_back(write_file(folder_, name, std::as_bytes(std::span(png))));
        } else {
            files_.push_back(write_file(folder_, name, bytes_of(array_of(frame.layers))));
        }
    }

    std::vector<FileRecord> finish() override { return files_; }

  private:
    std::string array_of(std::span<const LayerPixel> pixels) const {
        std::string values;
        for (const LayerPixel& pixel : pixels) layer.append(pixel, values);
        const std::string shape =
            std::to_string(height_) + ", " + std::to_string(width_) + (layer.components > 1 ? ", 3" : "");
        return npy_array(layer.type, shape, bytes_of(values));
    }

    std::vector<std::uint8_t> png_of(std::span<const LayerPixel> pixels) const {
        std::vector<std::uint16_t> values;
        for (const LayerPixel& pixel : pixels) layer.append16(pixel, values);
        return encode_png16(width_, height_, layer.components, values);
    }

    OutputFolder& folder_;
    std::uint32_t width_, height_;
    int digits_;
    std::vector<FileRecord> files_;
};

template <const Layer& layer>
constexpr OutputFormat layer_numbers(std::string_view files, std::string_view holds,
                                     std::uint64_t (*frame_bytes)(const FrameSize&)) {
    return {.name = layer.name,
            .files = files,
            .holds = holds,
            .layers = true,
            .frame_files = true,
            .frame_bytes = frame_bytes,
            .owns = [](std::string_view name) { return is_layer_file_name(layer, name, "npy"); },
            .open = open_writer<LayerFiles<layer, false>>};
}

template <const Layer& layer>
constexpr OutputFormat layer_pictures(std::string_view name, std::string_view files, std::string_view holds) {
    return {.name = name,
            .files = files,
            .holds = holds,
            .layers = true,
            .frame_files = true,
            .owns = [](std::string_view file_name) { return is_layer_file_name(layer, file_name, "png"); },
            .open = open_writer<LayerFiles<layer, true>>};
}

std::uint64_t four_bytes(const FrameSize& frame) { return 4 * frame.pixels; }
std::uint64_t twelve_bytes(const FrameSize& frame) { return 12 * frame.pixels; }
std::uint64_t two_bytes(const FrameSize& frame) { return 2 * frame.pixels; }

}  // namespace

extern const OutputFormat depth_format = layer_numbers<depth_layer>(
    "depth_FRAME.npy", "metres from the camera along its axis, float32 [row, column], infinity where nothing is",
    four_bytes);
extern const OutputFormat normal_format = layer_numbers<normal_layer>(
    "normal_FRAME.npy",
    "the unit normal of the side in view, in the world's axes, float32 [row, column, 3], else zeros", twelve_bytes);
extern const OutputFormat id_format = layer_numbers<id_layer>(
    "id_FRAME.npy",
    "what is seen, uint16 [row, column]: 0 nothing, from 1 on the cloths, after them the colliders, 65535 a fixture",
    two_bytes);
extern const OutputFormat strain_format = layer_numbers<strain_layer>(
    "strain_FRAME.npy",
    "the strain of the most stretched spring of the cloth there, float32 [row, column], 0 where no cloth is",
    four_bytes);
extern const OutputFormat depth16_format = layer_pictures<depth_layer>(
    "depth16", "depth_FRAME.png", "the depth in millimetres, 16-bit grey, 0 where nothing is");
extern const OutputFormat normal16_format = layer_pictures<normal_layer>(
    "normal16", "normal_FRAME.png", "the normal n as 32768 + 32767 n, 16-bit RGB, zeros where nothing is");
extern const OutputFormat id16_format = layer_pictures<id_layer>("id16", "id_FRAME.png", "the ids, 16-bit grey");
extern const OutputFormat strain16_format = layer_pictures<strain_layer>(
    "strain16", "strain_FRAME.png", "the strain e as 32768 + 10000 e, 16-bit grey, 0 where nothing is");

}  // namespace drape
