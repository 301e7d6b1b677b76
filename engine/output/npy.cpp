#include "output/npy.h"

#include <fmt/format.h>

#include <bit>
#include <limits>
#include <stdexcept>

namespace drape {

static_assert(std::endian::native == std::endian::little, "frames are written as they lie in memory");

namespace {

// The header has one size whatever the frame count, so that it can be corrected in place; a multiple of 64, so that a
// memory map of the data is aligned. The longest dictionary is 101 bytes.
constexpr size_t header_bytes = 128;

std::uint32_t checked_rows(const std::string& name, std::uint64_t frame_count, std::uint32_t row_count,
                           std::uint32_t column_count, const NpyValues& values) {
    const auto frame_bytes = static_cast<long double>(row_count) * column_count * values.components * values.bytes;
    if (row_count == 0 || column_count == 0 ||
        frame_bytes * static_cast<long double>(frame_count) >
            static_cast<long double>(std::numeric_limits<std::int64_t>::max() - header_bytes)) {
        throw std::invalid_argument(fmt::format("{}: no array of {} x {} x {} x {} values", name, frame_count,
                                                row_count, column_count, values.components));
    }
    return row_count;
}

}  // namespace

std::string npy_header(const char* type, const std::string& shape) {
    std::string dictionary = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, shape);
    constexpr size_t preamble_bytes = 10;  // magic, version, length of the rest
    dictionary.resize(header_bytes - preamble_bytes - 1, ' ');
    dictionary += '\n';
    std::string text("\x93NUMPY\x01\x00", 8);
    text += static_cast<char>(dictionary.size() & 0xff);
    text += static_cast<char>(dictionary.size() >> 8);
    return text + dictionary;
}

NpyWriter::NpyWriter(OutputFolder& folder, const std::string& name, std::uint64_t frame_count, std::uint32_t row_count,
                     std::uint32_t column_count, const NpyValues& values)
    : announced_count_(frame_count),
      row_count_(checked_rows(name, frame_count, row_count, column_count, values)),
      column_count_(column_count),
      values_(values),
      file_(folder, name) {
    file_.append(bytes_of(header(frame_count)));
}

std::string NpyWriter::header(std::uint64_t frame_count) const {
    const std::string components = values_.components > 1 ? fmt::format(", {}", values_.components) : "";
    return npy_header(values_.type, fmt::format("{}, {}, {}{}", frame_count, row_count_, column_count_, components));
}

std::vector<float> without_w(std::span<const float> xyzw) {
    std::vector<float> xyz(xyzw.size() / 4 * 3);
    for (size_t particle = 0; particle < xyzw.size() / 4; ++particle)
        for (size_t axis = 0; axis < 3; ++axis) xyz[3 * particle + axis] = xyzw[4 * particle + axis];
    return xyz;
}

std::string npy_array(const char* type, const std::string& shape, std::span<const std::byte> values) {
    return npy_header(type, shape).append(reinterpret_cast<const char*>(values.data()), values.size());
}

std::string face_array(std::span<const std::uint32_t> indices) {
    return npy_array("<i4", fmt::format("{}, 3", indices.size() / 3), std::as_bytes(indices));
}

std::string text_array(std::string_view text) {
    std::u32string wide(text.begin(), text.end());
    return npy_array(fmt::format("<U{}", wide.size()).c_str(), "", std::as_bytes(std::span(wide)));
}

void NpyWriter::append_bytes(std::span<const std::byte> frame) {
    const size_t expected = size_t{row_count_} * column_count_ * values_.components * values_.bytes;
    if (frame.size() != expected) {
        throw std::invalid_argument(
            fmt::format("NPY frame {}: expected {} bytes, got {}", written_count_, expected, frame.size()));
    }
    file_.append(frame);
    ++written_count_;
}

void NpyWriter::append_frame(std::span<const float> xyz) { append_bytes(std::as_bytes(xyz)); }

void NpyWriter::append_frame_xyzw(std::span<const float> xyzw) {
    if (xyzw.size() != size_t{row_count_} * column_count_ * 4) {
        throw std::invalid_argument(fmt::format("NPY frame {}: expected {} floats, got {}", written_count_,
                                                size_t{row_count_} * column_count_ * 4, xyzw.size()));
    }
    append_frame(without_w(xyzw));
}

const AtomicFile& NpyWriter::contents() {
    if (written_count_ != announced_count_) file_.rewrite(0, bytes_of(header(written_count_)));
    announced_count_ = written_count_;
    return file_;
}

FileRecord NpyWriter::finish() {
    contents();
    return file_.commit();
}

}  // namespace drape
