#include "drape/scene_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/output_error.h"
#include "base/printable_text.h"
#include "input/png_picture.h"
#include "mesh/mesh_file.h"
#include "mesh/sequence_file.h"
#include "scene/scene_node.h"
#include "scene/scene_text_file.h"

namespace drape {
namespace {

std::vector<SceneError> in_text_order(std::vector<PlacedError> placed) {
    std::stable_sort(placed.begin(), placed.end(),
                     [](const PlacedError& a, const PlacedError& b) { return a.offset < b.offset; });
    std::vector<SceneError> errors;
    errors.reserve(placed.size());
    for (PlacedError& error : placed) errors.push_back(std::move(error.error));
    return errors;
}

SceneResult failed(SceneError error) {
    SceneResult result;
    result.errors.push_back(std::move(error));
    return result;
}

std::string failure_text(const SceneResult& result) {
    std::string text;
    for (const SceneError& error : result.errors) {
        if (!text.empty()) text += '\n';
        text += error.text();
    }
    return text;
}

SceneDescription scene_or_throw(SceneResult result) {
    if (!result.scene) throw SceneFailure(std::move(result));
    return std::move(*result.scene);
}

}  // namespace

std::string SceneError::text() const {
    std::string place = file;
    if (line != 0) place += fmt::format(":{}:{}", line, column);
    if (!pointer.empty()) place += ": " + pointer;
    return printable(place + ": " + message);
}

SceneResult read_scene_text(std::string_view text, const std::string& file_name, std::span<const std::string> overrides,
                            const std::string& folder) {
    if (const std::string fault = size_fault(text.size()); !fault.empty()) return failed({file_name, 0, 0, "", fault});
    SceneDocument document(text, file_name);
    if (document.errors().empty())
        for (const std::string& override_text : overrides) document.apply_override(override_text);
    SceneResult result;
    if (!document.errors().empty()) {
        result.errors = first_errors(in_text_order(document.errors()), document.errors().size());
        return result;
    }
    SceneReport report{document, {}, {}, nullptr, Up::y, folder};
    for (const std::size_t comma : document.trailing_commas())
        report.errors.add(document, comma, "", SceneDocument::comma_message);
    SceneDescription scene;
    read_scene_object(SceneNode(report, document.root()), scene);
    result.errors = report.errors.told();
    result.warnings = report.warnings.told();
    result.files = std::move(report.files);
    if (result.errors.empty()) result.scene = std::move(scene);
    return result;
}

SceneResult read_scene(const std::string& path, std::span<const std::string> overrides) {
    TextFile file = read_text_file(path);
    if (!file.error.empty()) {
        SceneResult result = failed({path, 0, 0, "", file.error});
        result.unreadable = true;
        return result;
    }
    SceneResult result = read_scene_text(file.text, path, overrides, scene_folder(path));
    result.text = std::move(file.text);
    return result;
}

void read_file(Mesh& mesh) {
    mesh.sequence =
        mesh.frames.empty() ? nullptr : read_sequence(mesh.file, mesh.frames, mesh.scale, mesh.shell, mesh.solid);
    mesh.shape = mesh.sequence ? mesh.sequence->form() : read_mesh(mesh.file, mesh.scale, mesh.shell, mesh.solid);
}
void read_file(Appearance& appearance) {
    try {
        constexpr std::uint32_t most_side = 4096;
        Picture picture = read_png(appearance.texture);
        if (std::max(picture.width, picture.height) > most_side)
            throw OutputError(fmt::format("expected a picture of at most {} pixels a side, got {}x{}", most_side,
                                          picture.width, picture.height));
        appearance.image =
            std::make_shared<const TextureImage>(TextureImage{picture.width, picture.height, std::move(picture.rgb)});
    } catch (const OutputError& error) {
        throw Error(error.what());
    }
}

std::string scene_folder(const std::string& path) {
    std::error_code error;
    return std::filesystem::is_regular_file(path, error) ? std::filesystem::path(path).parent_path().string() : "";
}

SceneFailure::SceneFailure(SceneResult result) : Error(failure_text(result)), result_(std::move(result)) {}

SceneDescription load_scene(const std::string& path, std::span<const std::string> overrides) {
    return scene_or_throw(read_scene(path, overrides));
}

SceneDescription parse_scene(std::string_view text) { return scene_or_throw(read_scene_text(text, "scene")); }

}  // namespace drape
