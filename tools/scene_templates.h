// `drape new` writes these scenes.
#pragma once

#include <span>
#include <string_view>

namespace drape::cli {

struct SceneTemplate {
    std::string_view name, summary;
    std::string_view text;  ///< a commented scene file
};

std::span<const SceneTemplate> scene_templates();

}  // namespace drape::cli
