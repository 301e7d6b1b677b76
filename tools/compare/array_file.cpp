#include "compare/array_file.h"

#include <fmt/format.h>
#include <zip.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>
#include <regex>
#include <span>

#include "output/available_memory.h"
#include "output/output_error.h"

namespace drape::compare {

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

OutputError unreadable(const std::string& where, const std::string& why) {
    return OutputError(fmt::format("cannot read '{}': {}", where, why));
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

/// Reads so many bytes, or fewer where there are no more.
using Read = std::function<std::size_t(char* to, std::size_t count)>;

/// Reads an array of `size` bytes, which need not be in memory: its header is checked before its values are read.
/// https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
Array read_array(const Read& read, std::uint64_t size, const std::string& where) {
    constexpr std::size_t most_header = std::size_t{1} << 16;
    std::string head(std::min<std::uint64_t>(size, most_header), '\0');
    head.resize(read(head.data(), head.size()));
    const std::size_t preamble = head.size() > 6 && head[6] == 1 ? 10 : 12;
    if (!head.starts_with("\x93NUMPY") || head.size() < preamble) throw unreadable(where, "it is no NumPy array");
    std::uint32_t header_bytes = 0;
    std::memcpy(&header_bytes, head.data() + 8, preamble - 8);
    if (head.size() - preamble < header_bytes) throw unreadable(where, "it ends within its header");
    const std::string header = head.substr(preamble, header_bytes);
    std::smatch type, shape;
    if (!std::regex_search(header, type, std::regex("'descr': '([^']*)'")) ||
        !std::regex_search(header, shape, std::regex("'shape': \\(([0-9, ]*)\\)")))
        throw unreadable(where, "its header names no simple type and shape");
    if (header.find("'fortran_order': False") == std::string::npos)
        throw unreadable(where, "its values are in Fortran's order");
    Array array{{}, type[1], shape_of(shape[1], where), {}};
    const std::uint64_t value_bytes = size - preamble - header_bytes;
    if (array.has_numbers() && value_bytes != array.count() * find_type(array.type)->bytes)
        throw unreadable(where, fmt::format("it has {} bytes of values, not those of {}", value_bytes, array.text()));
    expect_memory(fmt::format("'{}'", where), value_bytes);
    array.bytes.resize(value_bytes);
    head.erase(0, preamble + header_bytes);
    std::ranges::copy(std::as_bytes(std::span(head)), array.bytes.begin());
    char* const rest = reinterpret_cast<char*>(array.bytes.data()) + head.size();
    if (read(rest, value_bytes - head.size()) != value_bytes - head.size())
        throw unreadable(where, "it ends too early");
    return array;
}

Array load_array(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(path, error);
    if (!file || error) throw unreadable(path.string(), "it is not there, or no file");
    const auto read = [&](char* to, std::size_t count) {
        file.read(to, static_cast<std::streamsize>(count));
        return static_cast<std::size_t>(file.gcount());
    };
    return read_array(read, size, path.string());
}

std::string array_name(const std::string& part) {
    return part.ends_with(".npy") ? part.substr(0, part.size() - 4) : part;
}

/// Reads an array of an archive.
Array load_part(zip_t* archive, zip_uint64_t index, const std::filesystem::path& path) {
    zip_stat_t stat;
    zip_stat_index(archive, index, 0, &stat);
    const std::string name = stat.name;
    const std::string where = path.string() + "', '" + name;
    const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(zip_fopen_index(archive, index, 0), zip_fclose);
    if (!file) throw unreadable(where, zip_strerror(archive));
    const auto read = [&](char* to, std::size_t count) {
        const zip_int64_t got = zip_fread(file.get(), to, count);
        if (got < 0) throw unreadable(where, zip_file_strerror(file.get()));
        return static_cast<std::size_t>(got);
    };
    Array array = read_array(read, stat.size, where);
    array.name = array_name(name);
    return array;
}

std::vector<Array> load_archive(const std::filesystem::path& path,
                                const std::function<bool(std::string_view)>& is_wanted) {
    int code = 0;
    const std::unique_ptr<zip_t, void (*)(zip_t*)> archive(zip_open(path.c_str(), ZIP_RDONLY, &code), zip_discard);
    if (!archive) {
        zip_error_t error;
        zip_error_init_with_code(&error, code);
        const std::string why = zip_error_strerror(&error);
        zip_error_fini(&error);
        throw unreadable(path.string(), why);
    }
    std::vector<Array> arrays;
    for (zip_int64_t i = 0; i < zip_get_num_entries(archive.get(), 0); ++i) {
        const auto index = static_cast<zip_uint64_t>(i);
        const char* part = zip_get_name(archive.get(), index, 0);
        if (!is_wanted || is_wanted(array_name(part ? part : "")))
            arrays.push_back(load_part(archive.get(), index, path));
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
    if (path.extension() == ".npz") return load_archive(path, is_wanted);
    std::vector<Array> one;
    one.push_back(load_array(path));
    return one;
}

}  // namespace drape::compare
