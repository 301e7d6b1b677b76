#include "input/ply_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <string_view>

#include "input/file_source.h"

namespace drape::input {

namespace {

enum class Encoding { ascii, little, big };

template <class T>
double ply_number(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

struct PlyType {
    std::string_view name, other_name;
    std::size_t bytes;
    bool is_whole;
    double (*value)(const char* bytes);
};
constexpr PlyType ply_types[] = {
    {"char", "int8", 1, true, ply_number<std::int8_t>},    {"uchar", "uint8", 1, true, ply_number<std::uint8_t>},
    {"short", "int16", 2, true, ply_number<std::int16_t>}, {"ushort", "uint16", 2, true, ply_number<std::uint16_t>},
    {"int", "int32", 4, true, ply_number<std::int32_t>},   {"uint", "uint32", 4, true, ply_number<std::uint32_t>},
    {"float", "float32", 4, false, ply_number<float>},     {"double", "float64", 8, false, ply_number<double>},
};

struct Property {
    std::string_view name;
    const PlyType* type;
    const PlyType* counted_by = nullptr;  ///< of a list
};

struct Element {
    std::string_view name;
    std::uint64_t count;
    std::uint64_t line;  ///< of the header
    std::vector<Property> properties = {};

    /// Returns the fewest bytes of one.
    std::uint64_t least_bytes(Encoding encoding) const {
        std::uint64_t sum = 0;
        for (const Property& each : properties)
            sum += encoding == Encoding::ascii ? 2 : each.counted_by ? each.counted_by->bytes : each.type->bytes;
        return sum;
    }
};

/// A file's bytes, and the place in them.
class Reader {
  public:
    Reader(const FileSource& file, std::string_view bytes) : name_(file.name()), bytes_(bytes) {}

    std::uint64_t line() const { return line_; }
    std::size_t left() const { return bytes_.size() - at_; }
    OutputError error_of_line(std::uint64_t line, const std::string& what) const {
        return unreadable(name_, fmt::format("line {}: {}", line, what));
    }
    OutputError error(const std::string& what) const {
        return encoding_ == Encoding::ascii ? error_of_line(line_, what)
                                            : unreadable(name_, fmt::format("byte {}: {}", at_, what));
    }
    void expect(bool holds, const char* what) const {
        if (!holds) throw error(what);
    }
    void set_encoding(Encoding encoding) { encoding_ = encoding; }
    Encoding encoding() const { return encoding_; }

    /// Returns a line of the header. The first line's end is that of all: a binary part may begin with any byte.
    std::string_view header_line() {
        if (at_ > 0) ++line_;
        const std::size_t end = bytes_.find_first_of("\r\n", at_);
        if (end == bytes_.npos) throw error_of_line(line_, "the header has no end");
        if (line_end_.empty()) line_end_ = bytes_.substr(end, bytes_.substr(end).starts_with("\r\n") ? 2 : 1);
        const std::string_view text = bytes_.substr(at_, end - at_);
        at_ = end + (bytes_.substr(end).starts_with(line_end_) ? line_end_.size() : 1);
        return text;
    }
    void end_header() { ++line_; }

    double next(const PlyType& type) { return encoding_ == Encoding::ascii ? next_word(type) : next_bytes(type); }

  private:
    double next_bytes(const PlyType& type) {
        expect(left() >= type.bytes, "the file ends too early");
        char bytes[8];
        std::memcpy(bytes, &bytes_[at_], type.bytes);
        if (encoding_ == Encoding::big) std::reverse(bytes, bytes + type.bytes);
        at_ += type.bytes;
        return type.value(bytes);
    }
    double next_word(const PlyType& type) {
        for (; at_ < bytes_.size() && std::string_view(" \t\r\n").find(bytes_[at_]) != std::string_view::npos; ++at_)
            line_ += bytes_[at_] == '\n' || (bytes_[at_] == '\r' && line_end_ == "\r");
        expect(left() > 0, "the file ends too early");
        if (bytes_[at_] == '+') ++at_;
        double value = 0;
        const char* const begin = bytes_.data() + at_;
        const auto [end, error] = std::from_chars(begin, bytes_.data() + bytes_.size(), value);
        at_ += static_cast<std::size_t>(end - begin);
        const bool ends =
            at_ == bytes_.size() || std::string_view(" \t\r\n").find(bytes_[at_]) != std::string_view::npos;
        expect(error == std::errc{} && ends, type.is_whole ? "expected a whole number" : "expected a number");
        expect(!type.is_whole || value == std::trunc(value), "expected a whole number");
        return value;
    }

    std::string name_;
    std::string_view bytes_, line_end_;
    std::size_t at_ = 0;
    std::uint64_t line_ = 1;
    Encoding encoding_ = Encoding::ascii;
};

std::string_view take_word(std::string_view& line) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    const std::string_view word = line.substr(0, std::min(line.find_first_of(" \t"), line.size()));
    line.remove_prefix(word.size());
    return word;
}

const PlyType& type_named(const Reader& reader, std::string_view name) {
    for (const PlyType& type : ply_types)
        if (name == type.name || name == type.other_name) return type;
    throw reader.error(fmt::format("expected a type of numbers, got \"{}\"", name.substr(0, 40)));
}

Encoding encoding_of(const Reader& reader, std::string_view rest) {
    const std::string_view name = take_word(rest);
    if (name == "ascii") return Encoding::ascii;
    if (name == "binary_little_endian") return Encoding::little;
    if (name == "binary_big_endian") return Encoding::big;
    throw reader.error(
        fmt::format("expected ascii, binary_little_endian or binary_big_endian, got \"{}\"", name.substr(0, 40)));
}

Element element_of(const Reader& reader, std::string_view rest) {
    Element element{take_word(rest), 0, reader.line()};
    const std::string_view count = take_word(rest);
    const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    reader.expect(error == std::errc{} && end == count.data() + count.size(), "expected an element's name and number");
    return element;
}

Property property_of(const Reader& reader, std::string_view rest) {
    std::string_view word = take_word(rest);
    Property property{};
    if (word == "list") {
        property.counted_by = &type_named(reader, take_word(rest));
        reader.expect(property.counted_by->is_whole, "expected a list counted by whole numbers");
        word = take_word(rest);
    }
    property.type = &type_named(reader, word);
    property.name = take_word(rest);
    reader.expect(!property.name.empty(), "expected a property's name");
    return property;
}

struct Header {
    Encoding encoding;
    std::vector<Element> elements;
};

Header read_header(Reader& reader) {
    reader.expect(reader.left() > 0 && reader.header_line() == "ply", "the first line of a PLY file is \"ply\"");
    std::optional<Encoding> encoding;
    std::vector<Element> elements;
    for (;;) {
        std::string_view rest = reader.header_line();
        const std::string_view keyword = take_word(rest);
        if (keyword == "end_header") break;
        if (keyword == "format") {
            encoding = encoding_of(reader, rest);
        } else if (keyword == "element") {
            elements.push_back(element_of(reader, rest));
        } else if (keyword == "property") {
            reader.expect(!elements.empty(), "a property stands before every element");
            elements.back().properties.push_back(property_of(reader, rest));
        } else {
            reader.expect(keyword.empty() || keyword == "comment" || keyword == "obj_info",
                          "expected format, element, property, comment or end_header");
        }
    }
    reader.expect(encoding.has_value(), "the header says no format");
    return {*encoding, std::move(elements)};
}

/// Refuses an element that cannot be in the bytes that are left.
void expect_bytes(const Reader& reader, const Element& element) {
    const std::uint64_t each = element.least_bytes(reader.encoding());
    const bool fits = each == 0 || element.count <= (reader.left() + 1) / each;  // a last word needs no blank
    if (!fits)
        throw reader.error_of_line(element.line,
                                   fmt::format("{} times \"{}\" need {} bytes each at least, the file has "
                                               "{} left",
                                               element.count, element.name.substr(0, 40), each, reader.left()));
}

std::uint64_t read_count(Reader& reader, const PlyType& type) {
    const double count = reader.next(type);
    reader.expect(count >= 0 && count <= static_cast<double>(reader.left()), "a list is longer than the file");
    return static_cast<std::uint64_t>(count);
}

void skip(Reader& reader, const Property& property) {
    const std::uint64_t count = property.counted_by ? read_count(reader, *property.counted_by) : 1;
    for (std::uint64_t k = 0; k < count; ++k) reader.next(*property.type);
}

void read_vertices(Reader& reader, const Element& element, MeshData& mesh) {
    const std::string_view axes[] = {"x", "y", "z"};
    for (const std::string_view axis : axes)
        if (std::ranges::count_if(element.properties,
                                  [&](const Property& each) { return each.name == axis && !each.counted_by; }) != 1)
            throw reader.error_of_line(element.line, fmt::format("a vertex has no number {}", axis));
    if (element.count > mesh_vertex_limit - std::min(mesh_vertex_limit, mesh.vertices.size()))
        throw reader.error_of_line(element.line, fmt::format("expected at most {} vertices", mesh_vertex_limit));
    for (std::uint64_t k = 0; k < element.count; ++k) {
        std::array<double, 3>& vertex = mesh.vertices.emplace_back();
        for (const Property& property : element.properties) {
            const auto axis = std::ranges::find(axes, property.name);
            if (axis == std::end(axes))
                skip(reader, property);
            else
                vertex[static_cast<std::size_t>(axis - axes)] = reader.next(*property.type);
        }
    }
}

/// Reads a list of corners. In a list of strips -1 ends one.
void read_corners(Reader& reader, const Property& list, bool is_strip, MeshData& mesh) {
    const std::uint64_t count = read_count(reader, *list.counted_by);
    std::vector<std::uint32_t> corners;
    for (std::uint64_t k = 0; k < count; ++k) {
        const double corner = reader.next(*list.type);
        if (is_strip && corner == -1) {
            add_strip(mesh, corners);
            corners.clear();
            continue;
        }
        reader.expect(corner >= 0 && corner < static_cast<double>(mesh_vertex_limit), "a corner is no vertex");
        corners.push_back(static_cast<std::uint32_t>(corner));
    }
    is_strip ? add_strip(mesh, corners) : add_face(mesh, corners);
}

void read_faces(Reader& reader, const std::string& file, const Element& element, MeshData& mesh) {
    for (std::uint64_t k = 0; k < element.count; ++k) {
        for (const Property& property : element.properties) {
            const bool is_corners = property.counted_by && property.type->is_whole &&
                                    (property.name == "vertex_indices" || property.name == "vertex_index");
            if (is_corners)
                read_corners(reader, property, element.name == "tristrips", mesh);
            else
                skip(reader, property);
        }
        expect_limits(mesh, file);
    }
}

}  // namespace

MeshData read_ply(const std::filesystem::path& path) {
    FileSource file(path);
    const std::vector<std::uint8_t> bytes = file.rest();
    Reader reader(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    const Header header = read_header(reader);
    reader.end_header();
    reader.set_encoding(header.encoding);
    MeshData mesh;
    for (const Element& element : header.elements) {
        if (element.properties.empty()) continue;  // it has no bytes, however often it is there
        expect_bytes(reader, element);
        if (element.name == "vertex")
            read_vertices(reader, element, mesh);
        else if (element.name == "face" || element.name == "tristrips")
            read_faces(reader, file.name(), element, mesh);
        else
            for (std::uint64_t k = 0; k < element.count; ++k)
                for (const Property& property : element.properties) skip(reader, property);
    }
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle)
            if (corner >= mesh.vertices.size())
                throw unreadable(file.name(), fmt::format("a face has the corner {}, there are {} vertices", corner,
                                                          mesh.vertices.size()));
    return mesh;
}

}  // namespace drape::input
