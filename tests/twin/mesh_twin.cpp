#include "twin/mesh_twin.h"

#include <mutex>

#include "twin/kernels.h"

namespace drape {

namespace {

/// Puts the samples of one mesh's field.
void put_samples(const glsl::FormPush& push, const FormLists& lists, std::vector<glsl::vec4>& texels) {
    const glsl::FormTables tables{lists.nodes.data(), lists.corners.data(), lists.guesses.data(), lists.sides.data()};
    const auto sample = [&](int x, int y, int z) {
        return static_cast<std::size_t>(glsl::sample_beside(push, x, y, z, 0, 0));
    };
    glsl::vec4* const at = texels.data() + push.size.w;
    std::vector<glsl::vec2> distances(sample(push.size.x - 1, push.size.y - 1, push.size.z - 1) + 1);
    const auto each = [&](const auto& see) {
        for (int z = 0; z < push.size.z; ++z)
            for (int y = 0; y < push.size.y; ++y)
                for (int x = 0; x < push.size.x; ++x) see(x, y, z);
    };
    each([&](int x, int y, int z) {
        const glsl::FormSample found = glsl::form_sample(push, x, y, z, tables);
        distances[sample(x, y, z)] = {found.begin, found.end};
        at[glsl::moving_point_texels * sample(x, y, z) + 2] = {found.way.x, found.way.y, found.way.z, 0};
    });
    each([&](int x, int y, int z) {
        const auto beside = [&](int up, int far) {
            return distances[static_cast<std::size_t>(glsl::sample_beside(push, x, y, z, up, far))];
        };
        const glsl::vec2 here = beside(0, 0), up = beside(1, 0), far = beside(0, 1), both = beside(1, 1);
        glsl::vec4* const texel = at + glsl::moving_point_texels * sample(x, y, z);
        texel[0] = {here.x, up.x, far.x, both.x};
        texel[1] = {here.y, up.y, far.y, both.y};
    });
    at[-1].w = push.substep;
}

/// The texels that were last asked for, and what they were made of.
struct Last {
    std::mutex mutex;
    std::shared_ptr<const FormLists> forms;
    std::shared_ptr<const std::vector<glsl::vec4>> rest;
    std::uint32_t substeps = 0;
    std::shared_ptr<const std::vector<glsl::vec4>> texels;
};

}  // namespace

std::shared_ptr<const std::vector<glsl::vec4>> twin_fields(const SimulationModel& model, const FrameInputs& inputs) {
    if (!inputs.forms) return nullptr;
    static Last last;
    const std::uint32_t substeps = model.scene.solver.substeps;
    const auto& rest = model.mesh_fields.shared_texels();
    const std::lock_guard lock(last.mutex);
    if (last.forms == inputs.forms && last.rest == rest && last.substeps == substeps) return last.texels;
    auto texels = std::make_shared<std::vector<glsl::vec4>>(*rest);
    for (const glsl::FormPush& push : model.mesh_fields.form_pushes(substeps))
        put_samples(push, *inputs.forms, *texels);
    last.forms = inputs.forms;
    last.rest = rest;
    last.substeps = substeps;
    last.texels = texels;
    return texels;
}

}  // namespace drape
