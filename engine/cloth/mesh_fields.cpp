#include "cloth/mesh_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <mutex>
#include <utility>

#include "drape/error.h"
#include "mesh/mesh_sequence.h"
#include "world/collider_pose.h"
#include "world/field_plan.h"
#include "world/overlap.h"

namespace drape {

namespace {

constexpr std::size_t kept_forms = 3,
                      kept_frames = 2;  ///< a frame has two forms, and the next frame begins with one of them

void append_head(const DistanceField& field, std::vector<glsl::vec4>& texels) {
    const auto at = [](double x) { return static_cast<float>(x); };
    texels.push_back({at(field.lower[0]), at(field.lower[1]), at(field.lower[2]), at(field.spacing)});
    texels.push_back({at(field.size[0]), at(field.size[1]), at(field.size[2]), 0});
}

void append(const DistanceField& field, std::vector<glsl::vec4>& texels) {
    append_head(field, texels);
    const auto& [columns, rows, layers] = field.size;
    for (std::size_t z = 0; z < layers; ++z)
        for (std::size_t y = 0; y < rows; ++y) {
            const std::size_t above = std::min<std::size_t>(y + 1, rows - 1);
            const std::size_t beyond = std::min<std::size_t>(z + 1, layers - 1);
            const auto row = [&, width = columns, height = rows](std::size_t of_y, std::size_t of_z) {
                return field.samples.data() + (of_z * height + of_y) * width;
            };
            const float *here = row(y, z), *up = row(above, z), *far = row(y, beyond), *both = row(above, beyond);
            for (std::size_t x = 0; x < columns; ++x) texels.push_back({here[x], up[x], far[x], both[x]});
        }
}

}  // namespace

/// Meshes that deform, and the last forms that were asked for, by the numbers of their poses.
class MeshFields::Forms {
  public:
    void add(const Mesh& mesh, const FieldPlan& plan, std::size_t first_sample) {
        FormedMesh& added = meshes_.emplace_back();
        added.mesh = mesh;
        added.field = empty_field(*mesh.shape, plan.spacing, plan.margin);
        added.exact = exact_within(plan.spacing, plan.margin);
        added.first_sample = first_sample;
        const FormLists lists = *added.lists(0);
        const auto count = [](const auto& list) { return static_cast<int>(list.size()); };
        added.count = {count(lists.nodes), count(lists.corners) / 3, count(lists.guesses), count(lists.sides)};
    }

    std::shared_ptr<const FormLists> of_frame(double from, double to) {
        const std::lock_guard lock(mutex_);
        for (const Frame& frame : recent_)
            if (frame.from == from && frame.to == to) return frame.lists;
        auto lists = std::make_shared<FormLists>();
        for (FormedMesh& mesh : meshes_)
            for (const double time : {from, to}) lists->append(*mesh.lists(time));
        recent_.push_back({from, to, lists});
        if (recent_.size() > kept_frames) recent_.pop_front();
        return lists;
    }

    std::vector<glsl::FormPush> pushes(std::uint32_t substeps) const {
        std::vector<glsl::FormPush> all;
        glsl::ivec4 first{0, 0, 0, 0};
        int distance = 0;
        for (const FormedMesh& mesh : meshes_) {
            glsl::FormPush& push = all.emplace_back(mesh.push());
            push.first = first;
            push.count = mesh.count;
            push.substep = static_cast<float>(1.0 / substeps);
            push.first_distance = distance;
            first = {first.x + 2 * push.count.x, first.y + 6 * push.count.y, first.z + 2 * push.count.z,
                     first.w + 2 * push.count.w};
            distance += push.size.x * push.size.y * push.size.z;
        }
        return all;
    }

  private:
    struct FormedMesh {
        Mesh mesh;
        DistanceField field;           ///< without its samples
        double exact = 0;              ///< m
        std::size_t first_sample = 0;  ///< texel
        glsl::ivec4 count{};           ///< of one form: nodes, triangles, guesses, words of sides
        std::deque<std::pair<double, std::shared_ptr<const FormLists>>> recent = {};

        std::shared_ptr<const FormLists> lists(double time) {
            const double pose = pose_number(mesh, time);
            for (const auto& [number, known] : recent)
                if (number == pose) return known;
            recent.emplace_back(pose,
                                std::make_shared<const FormLists>(form_lists(*mesh.sequence->at(pose), field, exact)));
            if (recent.size() > kept_forms) recent.pop_front();
            return recent.back().second;
        }

        glsl::FormPush push() const {
            const auto at = [](double x) { return static_cast<float>(x); };
            const auto size = [&](std::size_t axis) { return static_cast<int>(field.size[axis]); };
            glsl::FormPush push{};
            push.lower = {at(field.lower[0]), at(field.lower[1]), at(field.lower[2]), at(field.spacing)};
            push.size = {size(0), size(1), size(2), static_cast<int>(first_sample)};
            push.exact = at(exact * exact);
            push.half_shell = at(0.5 * mesh.shape->shell());
            return push;
        }
    };
    struct Frame {
        double from, to;  ///< s
        std::shared_ptr<const FormLists> lists;
    };
    std::mutex mutex_;
    std::vector<FormedMesh> meshes_;
    std::deque<Frame> recent_;
};

MeshFields::MeshFields(const SceneDescription& scene) {
    std::vector<glsl::vec4> texels;
    std::size_t points = 0;
    for (std::size_t k = 0; k < scene.colliders.size(); ++k) {
        const Mesh* mesh = special(scene.colliders[k].shape).mesh;
        if (!mesh) continue;
        if (!mesh->shape) throw Error("a mesh among the colliders was not read (read_file of drape/scene_reader.h)");
        const FieldPlan plan = field_plan(scene, scene.colliders[k]);
        points += plan.texels;
        if (points > most_field_points)
            throw Error(fmt::format("the distances to the scene's meshes need {} points up to {}, and have room for {}",
                                    points, mesh->file, most_field_points));
        first_.resize(k + 1);
        first_[k] = texels.size();
        const double thickness = 2 * mesh->shape->inner_radius();
        const bool has_room = field_points(*mesh->shape, thickness / 4, plan.margin) <= most_field_points;
        spacings_.push_back({k, plan.wanted, plan.spacing, thickness, has_room});
        if (!mesh->sequence) {
            append(*distance_field(mesh->shape, plan.spacing, plan.margin), texels);
            continue;
        }
        if (!forms_) forms_ = std::make_shared<Forms>();
        append_head(empty_field(*mesh->shape, plan.spacing, plan.margin), texels);
        forms_->add(*mesh, plan, texels.size());
        texels.resize(texels.size() + plan.texels);
    }
    if (!texels.empty()) texels_ = std::make_shared<const std::vector<glsl::vec4>>(std::move(texels));
}

std::shared_ptr<const FormLists> MeshFields::forms(double from, double to) const {
    return forms_ ? forms_->of_frame(from, to) : nullptr;
}

std::vector<glsl::FormPush> MeshFields::form_pushes(std::uint32_t substeps) const {
    return forms_ ? forms_->pushes(substeps) : std::vector<glsl::FormPush>{};
}

std::vector<Compromise> MeshFields::compromises(const SceneDescription& scene) const {
    std::vector<Compromise> all;
    for (const FieldSpacing& each : spacings_) {
        const std::string mesh = collider_place(scene, each.collider);
        if (each.thickness < 2 * each.spacing)
            all.push_back(
                {fmt::format("contact with {}", mesh),
                 fmt::format("it is at most {:.3g} m thick, and distances to it are known every {:.3g} m: cloth "
                             "may pass through; {}",
                             each.thickness, each.spacing,
                             each.has_room ? fmt::format("a \"spacing\" of {:.2g} helps", each.thickness / 4)
                                           : "a thicker mesh, or smaller parts of it, would help"),
                 0});
        else if (each.spacing > 2 * each.wanted)
            all.push_back({fmt::format("detail of {}", mesh),
                           fmt::format("distances to it are known every {:.3g} m, as a field of {} points allows, "
                                       "and cloth has particles every {:.3g} m; a \"spacing\" that is asked for may "
                                       "take more",
                                       each.spacing, scene.colliders[each.collider].deforms() ? "262144" : "2 million",
                                       2 * each.wanted),
                           0});
    }
    return all;
}

}  // namespace drape
