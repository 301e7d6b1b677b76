#include "reference/statistics.h"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "cloth/texels.h"
#include "reference/kernels.h"
#include "reference/mesh_twin.h"

namespace drape {

using namespace glsl;

namespace {

using Workgroup = std::array<StatisticsRecord, workgroup_width>;

StatisticsRecord joined_over_workgroup(Workgroup& lanes) {
    for (std::size_t stride = workgroup_width / 2; stride > 0; stride /= 2)
        for (std::size_t lane = 0; lane < stride; ++lane) lanes[lane] = joined(lanes[lane], lanes[lane + stride]);
    return lanes[0];
}

std::vector<StatisticsRecord> joined_in_chunks(const std::vector<StatisticsRecord>& records) {
    std::vector<StatisticsRecord> result;
    for (std::size_t first = 0; first < records.size(); first += statistics_chunk) {
        Workgroup lanes;
        lanes.fill(empty_statistics());
        for (std::size_t i = first; i < std::min(first + statistics_chunk, records.size()); ++i)
            lanes[i % workgroup_width] = joined(lanes[i % workgroup_width], records[i]);
        result.push_back(joined_over_workgroup(lanes));
    }
    return result;
}

/// Reduces one cloth's state as the shader's invocations do.
class Reduction {
  public:
    Reduction(const SimulationModel& model, const ClothModel& cloth, const TwinCloth& state, const FrameInputs& inputs)
        : state_(state),
          inputs_(inputs),
          colliders_(model.scene.colliders),
          made_(twin_fields(model, inputs)),
          fields_(made_ ? made_->data() : model.mesh_fields.data()),
          cloth_(cloth),
          push_(statistics_push(model, cloth)),
          reference_(statistics_reference(cloth)),
          masses_(mass_shares(cloth)) {}

    StatisticsRecord run() const {
        std::vector<StatisticsRecord> records;
        for (int row = 0; row < push_.grid.y; row += statistics_rows)
            for (int column = 0; column < push_.grid.x; ++column) records.push_back(part_of_column({column, row}));
        if (records.size() > statistics_chunk) records = joined_in_chunks(records);
        return joined_in_chunks(records).front();
    }

  private:
    StatisticsRecord part_of_column(ivec2 first) const {
        StatisticsRecord record = empty_statistics();
        for (int row = 0; row < statistics_rows; ++row) {
            const ivec2 particle{first.x, first.y + row};
            if (inside(particle)) record = joined(record, statistics_of(particle));
        }
        return record;
    }

    bool inside(ivec2 p) const { return p.x >= 0 && p.y >= 0 && p.x < push_.grid.x && p.y < push_.grid.y; }
    std::size_t at(ivec2 p) const { return static_cast<std::size_t>(p.y * push_.grid.x + p.x); }

    StatisticsRecord statistics_of(ivec2 particle) const {
        const std::size_t index = at(particle);
        const vec4 position = state_[Field::position][index];
        const float share = state_.topology.masked() ? masses_[index] : border_mass_share(particle, push_.grid);
        const vec3 velocity = xyz(state_[Field::displacement][index]) + xyz(state_[Field::end_excess][index]);
        StatisticsRecord record =
            particle_statistics(xyz(position), velocity, share, xyz(reference_), static_cast<uint>(index));
        if (record.counts.x != 0) return record;
        for (int direction = 0; direction < 4; ++direction) record = with_spring(record, particle, direction);
        if (position.w != 0.0f) record.extents.z = penetration(xyz(position), cloth_.skin_of(index).x);
        return record;
    }

    StatisticsRecord with_spring(const StatisticsRecord& record, ivec2 first, int direction) const {
        const ivec2 offset = spring_directions[static_cast<std::size_t>(direction)].offset;
        const ivec2 second{first.x + offset.x, first.y + offset.y};
        if (!inside(second)) return record;
        const float share = state_.topology.masked() ? component(state_.topology.spring_shares()[at(first)], direction)
                                                     : border_share(first, offset, push_.grid);
        const float tension = direction < 2 ? state_.tension(static_cast<std::size_t>(direction))[at(first)] : 0.0f;
        return add_spring_strain(
            record, xyz(state_[Field::position][at(first)]), xyz(state_[Field::position][at(second)]),
            state_.topology.cloth().rest_length(component(push_.rest_length, direction), at(first), direction),
            component(push_.half_stiffness, direction), share, push_.compression, tension, direction >= 2);
    }

    float penetration(vec3 position, float thickness) const {
        const vec3 rest{0, 0, 0};
        float deepest = 0.0f;
        for (std::size_t k = 0; k < colliders_.size(); ++k) {
            const ColliderRecord& record = inputs_.colliders[static_cast<std::size_t>(push_.collider_first) + k];
            const float depth =
                collider_contact(colliders_[k].kind(), record, position, rest, thickness, 0.0f, 1.0e30f, false, fields_)
                    .depth;
            deepest = depth > deepest ? depth : deepest;
        }
        return deepest;
    }

    const TwinCloth& state_;
    const FrameInputs& inputs_;
    const std::vector<drape::Collider>& colliders_;
    std::shared_ptr<const std::vector<vec4>> made_;  ///< fields of meshes that deform
    const vec4* fields_;
    const ClothModel& cloth_;
    StatisticsPush push_;
    vec4 reference_;
    std::vector<float> masses_;
};

}  // namespace

StatisticsRecord twin_statistics(const SimulationModel& model, std::size_t cloth, const TwinCloth& state,
                                 const FrameInputs& inputs) {
    return Reduction(model, model.cloths[cloth], state, inputs).run();
}

}  // namespace drape
