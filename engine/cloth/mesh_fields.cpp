#include "cloth/mesh_fields.h"

#include <fmt/format.h>

#include <algorithm>

#include "drape/error.h"
#include "scene/field_plan.h"
#include "scene/overlap.h"

namespace drape {

namespace {

void append(const DistanceField& field, std::vector<glsl::vec4>& texels) {
    const auto at = [](double x) { return static_cast<float>(x); };
    texels.push_back({at(field.lower[0]), at(field.lower[1]), at(field.lower[2]), at(field.spacing)});
    texels.push_back({at(field.size[0]), at(field.size[1]), at(field.size[2]), 0});
    const auto& [columns, rows, layers] = field.size;
    for (std::size_t z = 0; z < layers; ++z)
        for (std::size_t y = 0; y < rows; ++y) {
            const std::size_t above = std::min<std::size_t>(y + 1, rows - 1);
            const std::size_t beyond = std::min<std::size_t>(z + 1, layers - 1);
            const auto row = [&, columns = columns, rows = rows](std::size_t of_y, std::size_t of_z) {
                return field.samples.data() + (of_z * rows + of_y) * columns;
            };
            const float *here = row(y, z), *up = row(above, z), *far = row(y, beyond), *both = row(above, beyond);
            for (std::size_t x = 0; x < columns; ++x) texels.push_back({here[x], up[x], far[x], both[x]});
        }
}

}  // namespace

MeshFields::MeshFields(const SceneDescription& scene) {
    std::vector<glsl::vec4> texels;
    std::size_t points = 0;
    for (std::size_t k = 0; k < scene.colliders.size(); ++k) {
        const Mesh* mesh = std::get_if<Mesh>(&scene.colliders[k].shape);
        if (!mesh) continue;
        if (!mesh->shape) throw Error("a mesh among the colliders was not read (read_file of drape/scene_reader.h)");
        const FieldPlan plan = field_plan(scene, scene.colliders[k]);
        points += plan.points;
        if (points > most_field_points)
            throw Error(fmt::format("the distances to the scene's meshes need {} points up to {}, and have room for {}",
                                    points, mesh->file, most_field_points));
        const std::shared_ptr<const DistanceField> field = distance_field(mesh->shape, plan.spacing, plan.margin);
        first_.resize(k + 1);
        first_[k] = texels.size();
        spacings_.push_back({k, plan.wanted, plan.spacing, 2 * mesh->shape->inner_radius()});
        append(*field, texels);
    }
    if (!texels.empty()) texels_ = std::make_shared<const std::vector<glsl::vec4>>(std::move(texels));
}

std::vector<Compromise> MeshFields::compromises(const SceneDescription& scene) const {
    std::vector<Compromise> all;
    for (const FieldSpacing& each : spacings_) {
        const std::string mesh = collider_place(scene, each.collider);
        if (each.thickness < 2 * each.spacing)
            all.push_back(
                {fmt::format("contact with {}", mesh),
                 fmt::format("it is at most {:.3g} m thick, and distances to it are known every {:.3g} m: cloth "
                             "may pass through; a \"spacing\" of {:.2g} helps",
                             each.thickness, each.spacing, each.thickness / 4),
                 0});
        else if (each.spacing > 2 * each.wanted)
            all.push_back(
                {fmt::format("detail of {}", mesh),
                 fmt::format("distances to it are known every {:.3g} m, as a field of 2 million points allows, "
                             "and cloth has particles every {:.3g} m; a \"spacing\" that is asked for may "
                             "take more",
                             each.spacing, 2 * each.wanted),
                 0});
    }
    return all;
}

}  // namespace drape
