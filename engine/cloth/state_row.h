// A row of a table of state says what a field is called, what it holds, how large it is, how long it lives, when it is
// needed and what it contains at the start. Pure.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/struct_layout.h"

namespace drape {

enum class FieldLife : std::uint8_t {
    state,     ///< the next frame starts from it; it is carried over a cut, and equals the twin's to the bit
    frame,     ///< every frame writes it before reading it
    device,    ///< it stays on the device, and nothing else uses it
    constant,  ///< the host writes it at the start and after a cut
    input,     ///< the host writes it for every frame
};

/// The ways in which shaders may access a field.
enum class FieldView : std::uint8_t { image, buffer, texel_buffer, image_and_buffer };

struct FieldExtent {
    std::uint64_t width, height = 1;  ///< in texels, or in elements of a buffer
    std::uint64_t count() const { return width * height; }
};

/// `Name` is the enumeration of the table's fields; the functions of a row take a `Context`.
template <class Name, class Context>
struct StateRow {
    Name field;
    std::string_view name;  ///< the end of the resource's name
    FieldView view;
    const glsl::StructLayout& element;  ///< an image's is vec4 (rgba32f), float (r32f) or uint (r32ui)
    FieldLife life;
    bool (*needed)(const Context&);
    FieldExtent (*extent)(const Context&);
    /// Returns the bytes at the start or after a cut, at most as many as the extent holds. Null: zeros.
    std::vector<std::byte> (*start)(const Context&) = nullptr;
    /// Returns whether a pass rewrites a constant in every frame. Null: no pass does.
    bool (*rewritten)(const Context&) = nullptr;

    bool is_image() const { return view == FieldView::image || view == FieldView::image_and_buffer; }
    /// Returns the name in shaders, which has underscores.
    std::string variable() const {
        std::string text(name);
        std::ranges::replace_if(
            text, [](char c) { return c == ' ' || c == '-'; }, '_');
        return text;
    }
};

/// Returns the fields of a table by their names in shaders.
template <class Name, class Context>
std::map<std::string, Name, std::less<>> fields_by_variable(std::span<const StateRow<Name, Context>> rows) {
    std::map<std::string, Name, std::less<>> fields;
    for (const auto& row : rows) fields.emplace(row.variable(), row.field);
    return fields;
}
template <class Name>
std::optional<Name> found_in(const std::map<std::string, Name, std::less<>>& fields, std::string_view variable) {
    const auto found = fields.find(variable);
    return found == fields.end() ? std::nullopt : std::optional(found->second);
}

/// Returns the bytes of a list, for a row's start.
template <class T>
std::vector<std::byte> bytes_of_list(const std::vector<T>& values) {
    const auto bytes = std::as_bytes(std::span(values));
    return {bytes.begin(), bytes.end()};
}

}  // namespace drape
