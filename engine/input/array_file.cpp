#include "input/array_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <zip.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "input/available_memory.h"
#include "input/file_source.h"

namespace drape::input {

static_assert(std::endian::native == std::endian::little, "values are read as they lie in memory");

namespace {

template <class T>
double number(const std::byte* at) {
    T value;
    std::memcpy(&value, at, sizeof value);
    return static_cast<double>(value);
}

struct NumberType {
    std::string_view spelling, name;
    std::size_t bytes;
    double (*value)(const std::byte*);
};
constexpr NumberType number_types[] = {
    {"<f4", "float32", 4, number<float>},        {"<f8", "float64", 8, number<double>},
    {"|u1", "uint8", 1, number<std::uint8_t>},   {"|i1", "int8", 1, number<std::int8_t>},
    {"|b1", "bool", 1, number<std::uint8_t>},    {"<i2", "int16", 2, number<std::int16_t>},
    {"<u2", "uint16", 2, number<std::uint16_t>}, {"<i4", "int32", 4, number<std::int32_t>},
    {"<u4", "uint32", 4, number<std::uint32_t>}, {"<i8", "int64", 8, number<std::int64_t>},
    {"<u8", "uint64", 8, number<std::uint64_t>},
};

const NumberType* find_type(std::string_view spelling) {
    const auto found = std::ranges::find(number_types, spelling, &NumberType::spelling);
    return found == std::end(number_types) ? nullptr : &*found;
}

/// Parses the shape "61, 65, 3" of a header.
std::vector<std::uint64_t> shape_of(const std::string& text, const std::string& where) {
    std::vector<std::uint64_t> shape;
    std::uint64_t product = 1;
    for (const char* at = text.data(); at != text.data() + text.size();) {
        std::uint64_t size = 0;
        const auto [end, error] = std::from_chars(at, text.data() + text.size(), size);
        at = end == at ? at + 1 : end;  // over commas and spaces
        if (error == std::errc::invalid_argument) continue;
        if (error != std::errc{} || __builtin_mul_overflow(product, size, &product) || product > (1ull << 60))
            throw unreadable(where, "no array has its shape");
        shape.push_back(size);
    }
    return shape;
}

/// The source of an array's bytes.
struct Source {
    std::string where;   ///< for errors
    std::uint64_t size;  ///< bytes
    std::function<std::size_t(char* to, std::size_t count)> read;
    std::function<void(std::uint64_t count)> skip;
};

/// Memory is taken as bytes come, so that a file which claims more than it has costs nothing.
void read_bytes(const Source& source, std::uint64_t count, std::vector<std::byte>& bytes) {
    constexpr std::uint64_t most_at_once = std::uint64_t{16} << 20;
    bytes.reserve(count);
    while (bytes.size() < count) {
        const std::size_t before = bytes.size(), more = std::min(count - before, most_at_once);
        bytes.resize(before + more);
        if (source.read(reinterpret_cast<char*>(bytes.data() + before), more) != more)
            throw unreadable(source.where, "it ends too early");
    }
}

/// Returns the text between the two, the first of which follows `key`; nothing if a header has none.
std::optional<std::string> between(const std::string& header, const std::string& key, char open, char close) {
    const std::size_t at = header.find(key);
    if (at == header.npos) return {};
    const std::size_t begin = header.find_first_not_of(' ', at + key.size());
    if (begin == header.npos || header[begin] != open) return {};
    const std::size_t end = header.find(close, begin + 1);
    if (end == header.npos) return {};
    return header.substr(begin + 1, end - begin - 1);
}

/// Reads an array, which need not be in memory: its header is checked before its values are read.
/// https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
Array read_array(const Source& source, const WantedValues& wanted) {
    const std::string& where = source.where;
    std::string preamble(10, '\0');
    const bool has_preamble = source.read(preamble.data(), 10) == 10 && preamble.starts_with("\x93NUMPY");
    if (has_preamble && preamble[6] != 1) preamble.resize(12);
    if (!has_preamble || source.read(preamble.data() + 10, preamble.size() - 10) != preamble.size() - 10)
        throw unreadable(where, "it is no NumPy array");
    std::uint32_t header_bytes = 0;
    std::memcpy(&header_bytes, preamble.data() + 8, preamble.size() - 8);
    constexpr std::uint32_t most_header = 1u << 16;
    std::string header(std::min(header_bytes, most_header), '\0');
    if (header_bytes > most_header || source.read(header.data(), header.size()) != header.size())
        throw unreadable(where, "it ends within its header");
    const auto type = between(header, "'descr':", '\'', '\''), shape = between(header, "'shape':", '(', ')');
    if (!type || !shape || shape->find_first_not_of("0123456789, ") != shape->npos)
        throw unreadable(where, "its header names no simple type and shape");
    if (header.find("'fortran_order': False") == std::string::npos)
        throw unreadable(where, "its values are in Fortran's order");
    const bool swapped = type->starts_with('>');
    Array array{{}, swapped ? "<" + type->substr(1) : *type, shape_of(*shape, where), {}};
    const std::uint64_t value_bytes =
        source.size - std::min(source.size, preamble.size() + std::uint64_t{header_bytes});
    if (array.has_numbers() && value_bytes != array.count() * find_type(array.type)->bytes)
        throw unreadable(where, fmt::format("it has {} bytes of values, not those of {}", value_bytes, array.text()));
    std::uint64_t kept = value_bytes;
    if (wanted) {
        if (!array.has_numbers()) throw unreadable(where, fmt::format("it holds no numbers: {}", array.text()));
        kept = wanted(array) * find_type(array.type)->bytes;
    }
    expect_memory(fmt::format("'{}'", where), kept);
    source.skip(value_bytes - kept);
    read_bytes(source, kept, array.bytes);
    if (swapped && array.has_numbers())
        for (auto at = array.bytes.begin(); at != array.bytes.end(); at += find_type(array.type)->bytes)
            std::reverse(at, at + find_type(array.type)->bytes);
    return array;
}

Array load_npy(const std::filesystem::path& path, const WantedValues& wanted) {
    FileSource file(path);
    return read_array({file.name(), file.size(), [&](char* to, std::size_t count) { return file.read(to, count); },
                       [&](std::uint64_t count) { file.skip(count); }},
                      wanted);
}

using Archive = std::unique_ptr<zip_t, void (*)(zip_t*)>;

Archive open_archive(const std::filesystem::path& path) {
    const FileSource regular(path);  // libzip would wait for a pipe
    int code = 0;
    Archive archive(zip_open(path.c_str(), ZIP_RDONLY, &code), zip_discard);
    if (archive) return archive;
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    const std::string why = zip_error_strerror(&error);
    zip_error_fini(&error);
    throw unreadable(path.string(), why);
}

std::string array_name(const std::string& part) {
    return part.ends_with(".npy") ? part.substr(0, part.size() - 4) : part;
}

/// Reads an array of an archive.
Array load_part(zip_t* archive, zip_uint64_t index, const std::filesystem::path& path, const WantedValues& wanted) {
    zip_stat_t stat;
    if (zip_stat_index(archive, index, 0, &stat) != 0) throw unreadable(path.string(), zip_strerror(archive));
    const std::string name = stat.name;
    const std::string where = path.string() + "', '" + name;
    const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(zip_fopen_index(archive, index, 0), zip_fclose);
    if (!file) throw unreadable(where, zip_strerror(archive));
    const auto read = [&](char* to, std::size_t count) {
        std::size_t done = 0;
        while (done < count) {
            const zip_int64_t got = zip_fread(file.get(), to + done, count - done);
            if (got < 0) throw unreadable(where, zip_file_strerror(file.get()));
            if (got == 0) break;
            done += static_cast<std::size_t>(got);
        }
        return done;
    };
    // An uncompressed part can be skipped; of a compressed one every byte must be decompressed, and few bytes may
    // become many.
    const auto skip = [&](std::uint64_t count) {
        if (stat.comp_method == ZIP_CM_STORE) {
            if (zip_fseek(file.get(), static_cast<zip_int64_t>(count), SEEK_CUR) != 0)
                throw unreadable(where, zip_file_strerror(file.get()));
            return;
        }
        constexpr std::uint64_t most_unpacked = std::uint64_t{4} << 30;
        if (count > most_unpacked)
            throw unreadable(where, fmt::format("{} bytes lie packed before what is wanted, at most {} are unpacked",
                                                count, most_unpacked));
        std::vector<char> chunk(std::size_t{1} << 20);
        while (count > 0) {
            const std::size_t got = read(chunk.data(), std::min<std::uint64_t>(count, chunk.size()));
            if (got == 0) throw unreadable(where, "it ends too early");
            count -= got;
        }
    };
    Array array = read_array({where, stat.size, read, skip}, wanted);
    array.name = array_name(name);
    return array;
}

std::vector<Array> load_archive(const std::filesystem::path& path,
                                const std::function<bool(std::string_view)>& is_wanted) {
    const Archive archive = open_archive(path);
    std::vector<Array> arrays;
    for (zip_int64_t i = 0; i < zip_get_num_entries(archive.get(), 0); ++i) {
        const auto index = static_cast<zip_uint64_t>(i);
        const char* part = zip_get_name(archive.get(), index, 0);
        if (!is_wanted || is_wanted(array_name(part ? part : "")))
            arrays.push_back(load_part(archive.get(), index, path, {}));
    }
    std::ranges::sort(arrays, {}, &Array::name);
    return arrays;
}

}  // namespace

bool Array::has_numbers() const { return find_type(type) != nullptr; }

std::size_t Array::count() const {
    std::size_t product = 1;
    for (const std::uint64_t size : shape) product *= size;
    return product;
}

double Array::value(std::size_t index) const {
    const NumberType& known = *find_type(type);
    return known.value(&bytes[index * known.bytes]);
}

std::string Array::text() const {
    const NumberType* known = find_type(type);
    return fmt::format("{} ({})", known ? known->name : std::string_view(type), fmt::join(shape, ", "));
}

std::string Array::place(std::size_t index) const {
    std::vector<std::size_t> indices(shape.size());
    for (std::size_t axis = shape.size(); axis-- > 0; index /= shape[axis]) indices[axis] = index % shape[axis];
    return fmt::format("({})", fmt::join(indices, ", "));
}

std::vector<Array> load_arrays(const std::filesystem::path& path,
                               const std::function<bool(std::string_view)>& is_wanted) {
    if (extension_of(path) == ".npz") return load_archive(path, is_wanted);
    std::vector<Array> one;
    one.push_back(load_npy(path, {}));
    return one;
}

Array load_array(const std::filesystem::path& path, std::string_view name, const WantedValues& wanted) {
    if (extension_of(path) != ".npz") return load_npy(path, wanted);
    const Archive archive = open_archive(path);
    const zip_int64_t index = zip_name_locate(archive.get(), fmt::format("{}.npy", name).c_str(), 0);
    if (index < 0) throw unreadable(path.string(), fmt::format("it has no array \"{}\"", name));
    return load_part(archive.get(), static_cast<zip_uint64_t>(index), path, wanted);
}

}  // namespace drape::input
