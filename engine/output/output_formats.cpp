#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "output/frame_writer.h"

namespace drape {

extern const OutputFormat png_format, npy_format, npz_format, pc2_format, obj_format, ply_format, usda_format,
    vtu_format, y4m_format, rgb_format, mgn_format, depth_format, normal_format, id_format, strain_format,
    depth16_format, normal16_format, id16_format, strain16_format;

namespace {

constexpr const OutputFormat* table[] = {
    &png_format,    &npy_format,     &npz_format,      &pc2_format,  &obj_format,     &ply_format,    &usda_format,
    &vtu_format,    &mgn_format,     &y4m_format,      &rgb_format,  &depth_format,   &normal_format, &id_format,
    &strain_format, &depth16_format, &normal16_format, &id16_format, &strain16_format};

/// Returns what stands between the two; nothing when the name does not begin and end so.
std::optional<std::string_view> middle(std::string_view name, std::string_view begin, std::string_view end) {
    if (name.size() < begin.size() + end.size() || !name.starts_with(begin) || !name.ends_with(end))
        return std::nullopt;
    return name.substr(begin.size(), name.size() - begin.size() - end.size());
}

template <class Wanted>
std::string names_of(const Wanted& wanted) {
    std::vector<std::string_view> names;
    for (const OutputFormat* format : table)
        if (wanted(*format)) names.push_back(format->name);
    return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

std::span<const OutputFormat* const> output_formats() { return table; }

const OutputFormat* find_output_format(std::string_view name) {
    const auto found = std::ranges::find(table, name, [](const OutputFormat* format) { return format->name; });
    return found == std::end(table) ? nullptr : *found;
}

std::string export_format_names(bool drawn) {
    return names_of([drawn](const OutputFormat& format) { return exported(format, drawn); });
}

std::string stream_format_names() {
    return names_of([](const OutputFormat& format) { return format.stream != nullptr; });
}

bool exported(const OutputFormat& format, bool drawn) { return &format != &png_format && (drawn || !format.draws); }

std::array<float, 2> WrittenCloth::uv(std::size_t particle) const {
    if (!panel.empty())
        return {static_cast<float>(panel[particle][0] / size[0]), static_cast<float>(1 - panel[particle][1] / size[1])};
    const auto share = [](std::size_t index, std::uint32_t count) {
        return static_cast<float>(static_cast<double>(index) / (count - 1));
    };
    return {share(particle % columns, columns), share(rows - 1 - particle / columns, rows)};
}

int frame_digits(std::uint64_t last_frame) {
    return std::max(4, static_cast<int>(fmt::formatted_size("{}", last_frame)));
}

std::string cloth_file_name(std::string_view stem, const WrittenCloth& cloth, std::string_view extension) {
    return fmt::format("{}{}{}.{}", stem, cloth.name.empty() ? "" : "_", cloth.name, extension);
}

bool is_cloth_file_name(std::string_view name, std::string_view stem, std::string_view extension) {
    const auto cloth = middle(name, stem, fmt::format(".{}", extension));
    return cloth && (cloth->empty() || (cloth->size() > 1 && cloth->front() == '_'));
}

std::string cloth_frame_file_name(std::string_view stem, const WrittenCloth& cloth, std::uint64_t frame, int digits,
                                  std::string_view extension) {
    return fmt::format("{}_{}{}{:0{}}.{}", stem, cloth.name, cloth.name.empty() ? "" : "_", frame, digits, extension);
}

bool is_cloth_frame_file_name(std::string_view name, std::string_view stem, std::string_view extension) {
    const auto rest = middle(name, fmt::format("{}_", stem), fmt::format(".{}", extension));
    if (!rest) return false;
    const std::string_view digits = rest->substr(rest->rfind('_') + 1);  // npos + 1 is 0
    return digits.size() >= 4 && std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace drape
