#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "output/atomic_file.h"

namespace drape {

// Returns x y z per particle, from x y z w.
std::vector<float> without_w(std::span<const float> xyzw);

// Returns the first 128 bytes of a NumPy file, which can be replaced once the file has grown. `type` and `shape` are as
// below.
std::string npy_header(const char* type, const std::string& shape);

// Returns a whole NumPy file: `type` as NumPy spells it ("<f4"), `shape` as in a tuple ("2, 3" or "2,").
std::string npy_array(const char* type, const std::string& shape, std::span<const std::byte> values);

// Returns a face list: little-endian int32, shape [face, 3], particle indices row * columns + column.
std::string face_array(std::span<const std::uint32_t> indices);

// Returns a JSON text, or any other of ASCII characters, as a string of no dimension.
std::string text_array(std::string_view text);

// The values that a frame's array holds for each particle.
struct NpyValues {
    const char* type = "<f4";
    std::uint32_t bytes = 4;       // per component
    std::uint32_t components = 3;  // 1: the array has no axis for them
};

// What npz and npy files call the forces on springs and particles, and the springs that are there
// (FinishedFrame, Simulation::spring_bits).
inline constexpr const char *tension_name = "tension", *contact_force_name = "contact_force", *springs_name = "springs";
inline constexpr NpyValues tension_values{"<f4", 4, 4};

// Streams frames into a NumPy file: C order, shape [frame, row, column, 3], positions as little-endian float32, in
// version 1.0 of https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html. The file appears at finish();
// a writer that ends without it leaves nothing.
class NpyWriter {
  public:
    // Throws std::invalid_argument when rows or columns are 0 or the array would exceed 2^63 bytes, and OutputError.
    NpyWriter(OutputFolder& folder, const std::string& name, std::uint64_t frame_count, std::uint32_t row_count,
              std::uint32_t column_count, const NpyValues& values = {});

    // Appends one frame of any type. Throws std::invalid_argument on another size.
    void append_bytes(std::span<const std::byte> frame);
    // Appends one frame: row_count * column_count particles, x y z each. Throws std::invalid_argument on another size.
    void append_frame(std::span<const float> xyz);
    // Appends one frame of x y z w; w is dropped.
    void append_frame_xyzw(std::span<const float> xyzw);

    std::uint64_t frame_count() const { return written_count_; }

    // Corrects the header when fewer or more frames came than announced (an interrupted run).
    FileRecord finish();
    // Returns the file as finish() would leave it, for a writer that ends without.
    const AtomicFile& contents();

  private:
    std::string header(std::uint64_t frame_count) const;

    std::uint64_t announced_count_;
    std::uint64_t written_count_ = 0;
    std::uint32_t row_count_;
    std::uint32_t column_count_;
    NpyValues values_;
    AtomicFile file_;
};

}  // namespace drape
