#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "output/file_descriptor.h"
#include "output/kept_frames.h"
#include "output/output_folder.h"

namespace drape {

// Keeps numbers about the frames of a run, however many: data beyond a megabyte is stored in an unnamed file in the
// run's folder, which disappears when the program ends. Every member but the first throws OutputError.
class FrameTable {
  public:
    // `folder` must outlive this.
    explicit FrameTable(OutputFolder& folder) : folder_(folder) {}

    // Adds a frame's values, in any order of frames; if a frame comes twice, the later values count. NaN means no
    // value.
    void add(std::uint32_t frame, const FrameValues& values);

    // Calls take(frame, values) for every frame, in order of their numbers.
    void for_each(const std::function<void(std::uint32_t, const FrameValues&)>& take) const;

    // Return, in the order in which frames were added, their numbers, and the values with a name, NaN where there is
    // none.
    std::vector<std::uint32_t> frames() const;
    std::vector<double> column(const std::string& name) const;
    // Returns the names of all frames' values, sorted.
    std::vector<std::string> names() const;

  private:
    struct Row {
        std::uint64_t offset = 0;  // offset of its values
        std::uint32_t frame = 0;
        std::span<const double> values;  // values of the first columns
    };
    void write_waiting();
    void read_at(std::uint64_t offset, std::span<std::byte> bytes) const;
    void scan(const std::function<void(const Row&)>& take) const;

    OutputFolder& folder_;
    std::map<std::string, std::size_t> columns_;  // column of each name, in the order in which names came
    FileDescriptor file_;
    std::uint64_t length_ = 0;  // bytes in the file; waiting values follow them
    std::vector<std::byte> waiting_;
};

}  // namespace drape
