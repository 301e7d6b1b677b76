#include "output/frame_table.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>

namespace drape {

namespace {

constexpr std::size_t most_waiting = std::size_t{1} << 20;
constexpr double none = std::numeric_limits<double>::quiet_NaN();
// A row begins with the frame's number and how many values follow.
using Head = std::array<std::uint32_t, 2>;

}  // namespace

void FrameTable::add(std::uint32_t frame, const FrameValues& values) {
    std::vector<double> row(columns_.size(), none);
    for (const auto& [name, value] : values) {
        const auto [column, is_new] = columns_.try_emplace(name, columns_.size());
        if (is_new) row.push_back(none);
        row[column->second] = value;
    }
    const Head head{frame, static_cast<std::uint32_t>(row.size())};
    const auto append = [&](std::span<const std::byte> bytes) {
        waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
    };
    append(std::as_bytes(std::span(head)));
    append(std::as_bytes(std::span(row)));
    if (waiting_.size() > most_waiting) write_waiting();
}

void FrameTable::write_waiting() {
    // The error names the manifest: the values come to it, or are all that keeps it from being written.
    const auto error = [&] { return system_error_at("write", folder_.path_of(manifest_file_name), errno); };
    if (!file_) {
        folder_.begin_writing();
        const std::string name = fmt::format("{}.tmp-{}", manifest_file_name, getpid());
        file_ = FileDescriptor(openat(folder_.descriptor(), name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
        if (!file_ || unlinkat(folder_.descriptor(), name.c_str(), 0) != 0) throw error();
    }
    for (std::span<const std::byte> rest(waiting_); !rest.empty();) {
        const std::size_t written = waiting_.size() - rest.size();
        const ssize_t count = pwrite(file_.get(), rest.data(), rest.size(), static_cast<off_t>(length_ + written));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throw error();
        rest = rest.subspan(static_cast<std::size_t>(count));
    }
    length_ += waiting_.size();
    waiting_.clear();
}

void FrameTable::read_at(std::uint64_t offset, std::span<std::byte> bytes) const {
    while (!bytes.empty()) {
        std::size_t got = 0;
        if (offset >= length_) {
            got = bytes.size();
            std::memcpy(bytes.data(), waiting_.data() + (offset - length_), got);
        } else {
            const auto wanted = std::min<std::uint64_t>(bytes.size(), length_ - offset);
            const ssize_t count = pread(file_.get(), bytes.data(), wanted, static_cast<off_t>(offset));
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0)
                throw system_error_at("write", folder_.path_of(manifest_file_name), count < 0 ? errno : EIO);
            got = static_cast<std::size_t>(count);
        }
        bytes = bytes.subspan(got);
        offset += got;
    }
}

void FrameTable::scan(const std::function<void(const Row&)>& take) const {
    const std::uint64_t end = length_ + waiting_.size();
    std::vector<std::byte> block;
    std::vector<double> values;
    std::uint64_t begin = 0;  // offset of the block
    const auto copy = [&](std::uint64_t offset, std::span<std::byte> bytes) {
        if (offset + bytes.size() > begin + block.size() || offset < begin) {
            block.resize(std::min<std::uint64_t>(end - offset, std::max(most_waiting, bytes.size())));
            begin = offset;
            read_at(begin, block);
        }
        std::memcpy(bytes.data(), block.data() + (offset - begin), bytes.size());
    };
    for (std::uint64_t offset = 0; offset < end;) {
        Head head;
        copy(offset, std::as_writable_bytes(std::span(head)));
        offset += sizeof head;
        values.resize(head[1]);
        if (!values.empty()) copy(offset, std::as_writable_bytes(std::span(values)));
        take({offset, head[0], values});
        offset += values.size() * sizeof(double);
    }
}

void FrameTable::for_each(const std::function<void(std::uint32_t, const FrameValues&)>& take) const {
    struct Place {
        std::uint32_t frame, count;
        std::uint64_t offset;
    };
    std::vector<Place> places;
    scan([&](const Row& row) {
        places.push_back({row.frame, static_cast<std::uint32_t>(row.values.size()), row.offset});
    });
    std::ranges::stable_sort(places, {}, &Place::frame);
    std::vector<double> row;
    for (std::size_t k = 0; k < places.size(); ++k) {
        if (k + 1 < places.size() && places[k + 1].frame == places[k].frame) continue;
        row.resize(places[k].count);
        if (!row.empty()) read_at(places[k].offset, std::as_writable_bytes(std::span(row)));
        FrameValues values;
        for (const auto& [name, column] : columns_)
            if (column < row.size() && !std::isnan(row[column])) values[name] = row[column];
        take(places[k].frame, values);
    }
}

std::vector<std::uint32_t> FrameTable::frames() const {
    std::vector<std::uint32_t> numbers;
    scan([&](const Row& row) { numbers.push_back(row.frame); });
    return numbers;
}

std::vector<double> FrameTable::column(const std::string& name) const {
    const auto found = columns_.find(name);
    std::vector<double> values;
    scan([&](const Row& row) {
        const bool has = found != columns_.end() && found->second < row.values.size();
        values.push_back(has ? row.values[found->second] : none);
    });
    return values;
}

std::vector<std::string> FrameTable::names() const {
    std::vector<std::string> all;
    for (const auto& [name, column] : columns_) all.push_back(name);
    return all;
}

}  // namespace drape
