#include "output/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <xxhash.h>

#include <algorithm>
#include <cerrno>

#include "base/byte_stream.h"
#include "base/output_error.h"

namespace drape {

namespace {

constexpr std::string_view magic = "DRAPEJNL";
constexpr std::uint32_t version = 5;
// The largest number of bytes that wait in memory while there is no file, and once there is one.
constexpr std::size_t most_before_file = std::size_t{8} << 20, most_behind_file = std::size_t{1} << 20;

template <class Archive, class Record>
void transfer(Archive& archive, Record& record, std::uint32_t& kind) {
    archive(kind, record.frame);
    if (kind == static_cast<std::uint32_t>(JournalRecord::Kind::cut))
        archive(record.cloth, record.springs, record.torn, record.triangles, record.pieces, record.crumbs, record.faces,
                record.spring_bits);
}

void put_values(ByteWriter& writer, const JournalRecord& record) {
    writer(std::uint64_t{record.values.size()});
    for (const auto& [name, value] : record.values) writer(name, value);
    for (const auto* arrays : {&record.positions, &record.velocities, &record.tensions, &record.contact_forces}) {
        writer(std::uint64_t{arrays->size()});
        for (const std::vector<float>& cloth : *arrays) {
            writer(std::uint64_t{cloth.size()});
            writer.put_bytes(std::as_bytes(std::span(cloth)));
        }
    }
}

void get_arrays(ByteReader& reader, std::vector<std::vector<float>>& arrays) {
    std::uint64_t count = 0;
    for (reader(count); count > 0; --count) {
        std::uint64_t floats = 0;
        reader(floats);
        if (floats > reader.left() / sizeof(float)) throw Error("it ends too early");
        std::vector<float>& cloth = arrays.emplace_back(static_cast<std::size_t>(floats));
        const auto bytes = reader.get_bytes(floats * sizeof(float));
        std::ranges::copy(bytes, std::as_writable_bytes(std::span(cloth)).begin());  // memcpy takes no null pointer
    }
}

void get_values(ByteReader& reader, JournalRecord& record) {
    std::uint64_t count = 0;
    for (reader(count); count > 0; --count) {
        std::string name;
        reader(name);
        reader(record.values[name]);
    }
    for (auto* const arrays : {&record.positions, &record.velocities, &record.tensions, &record.contact_forces})
        get_arrays(reader, *arrays);
}

std::vector<std::byte> head_of(const std::string& run_key) {
    ByteWriter writer;
    writer.put_bytes(std::as_bytes(std::span(magic)));
    writer(version, run_key);
    return writer.take();
}

}  // namespace

std::vector<std::byte> encode_record(const JournalRecord& record) {
    ByteWriter writer;
    auto kind = static_cast<std::uint32_t>(record.kind);
    transfer(writer, record, kind);
    if (record.kind == JournalRecord::Kind::frame) put_values(writer, record);
    return writer.take();
}

JournalRecord decode_record(std::span<const std::byte> bytes) {
    ByteReader reader(bytes);
    JournalRecord record;
    std::uint32_t kind = 0;
    transfer(reader, record, kind);
    if (kind > static_cast<std::uint32_t>(JournalRecord::Kind::cut)) throw Error("a record of no kind");
    record.kind = static_cast<JournalRecord::Kind>(kind);
    if (record.kind == JournalRecord::Kind::frame) get_values(reader, record);
    if (reader.left() > 0) throw Error("something follows a record");
    return record;
}

void Journal::open_file(bool keep) {
    folder_.begin_writing();
    const int flags = O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC | (keep ? 0 : O_TRUNC);
    file_ = FileDescriptor(openat(folder_.descriptor(), std::string(journal_file_name).c_str(), flags, 0666));
    if (!file_) throw system_error_at("write", folder_.path_of(journal_file_name), errno);
}

void Journal::add(const JournalRecord& record) {
    const std::vector<std::byte> payload = encode_record(record);
    ByteWriter framed;
    framed(std::uint64_t{payload.size()});
    framed.put_bytes(payload);
    framed(std::uint64_t{XXH3_64bits(payload.data(), payload.size())});
    const std::vector<std::byte> bytes = framed.take();
    waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
    if (waiting_.size() > (file_ ? most_behind_file : most_before_file)) write_waiting();
}

void Journal::write_waiting() {
    if (!file_) {
        open_file(false);
        const std::vector<std::byte> head = head_of(run_key_);
        waiting_.insert(waiting_.begin(), head.begin(), head.end());
    }
    for (std::span<const std::byte> rest(waiting_); !rest.empty();) {
        const ssize_t count = pwrite(file_.get(), rest.data(), rest.size(), static_cast<off_t>(length_));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throw system_error_at("write", folder_.path_of(journal_file_name), errno);
        length_ += static_cast<std::uint64_t>(count);
        rest = rest.subspan(static_cast<std::size_t>(count));
    }
    waiting_.clear();
}

std::uint64_t Journal::sync() {
    write_waiting();
    if (fsync(file_.get()) != 0) throw system_error_at("write", folder_.path_of(journal_file_name), errno);
    return length_;
}

void Journal::go_on_behind(std::uint64_t length) {
    open_file(true);
    if (ftruncate(file_.get(), static_cast<off_t>(length)) != 0)
        throw system_error_at("write", folder_.path_of(journal_file_name), errno);
    length_ = length;
}

void Journal::read(std::uint64_t length, const std::function<void(JournalRecord&&)>& take) const {
    const std::string path = folder_.path_of(journal_file_name);
    const FileDescriptor file(openat(folder_.descriptor(), std::string(journal_file_name).c_str(),
                                     O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (!file) throw system_error_at("read", path, errno);
    struct stat status {};
    if (fstat(file.get(), &status) != 0) throw system_error_at("read", path, errno);
    std::uint64_t at = 0;
    const auto damaged = [&] { return OutputError(fmt::format("'{}' is damaged at byte {}", path, at)); };
    const auto next = [&](std::uint64_t count) {
        if (count > length - at) throw damaged();
        std::vector<std::byte> bytes(static_cast<std::size_t>(count));
        for (std::size_t done = 0; done < bytes.size();) {
            const ssize_t got =
                pread(file.get(), bytes.data() + done, bytes.size() - done, static_cast<off_t>(at + done));
            if (got < 0 && errno == EINTR) continue;
            if (got <= 0) throw damaged();
            done += static_cast<std::size_t>(got);
        }
        at += count;
        return bytes;
    };
    if (length > static_cast<std::uint64_t>(status.st_size)) throw damaged();
    const std::vector<std::byte> head = head_of(run_key_);
    if (next(head.size()) != head)
        throw OutputError(fmt::format("'{}' is of another run, or of another version of this program", path));
    while (at < length) {
        std::uint64_t size = 0, sum = 0;
        ByteReader(next(sizeof size))(size);
        if (length - at < sizeof sum || size > length - at - sizeof sum) throw damaged();
        const std::vector<std::byte> payload = next(size);
        ByteReader(next(sizeof sum))(sum);
        if (sum != XXH3_64bits(payload.data(), payload.size())) throw damaged();
        try {
            take(decode_record(payload));
        } catch (const Error&) {
            throw damaged();
        }
    }
}

}  // namespace drape
