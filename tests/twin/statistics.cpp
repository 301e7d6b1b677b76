#include "twin/statistics.h"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "cloth/texels.h"
#include "twin/kernels.h"
#include "twin/mesh_twin.h"

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
        if (first.x == 0 && first.y == 0 && !state_[Field::angular_error].empty()) {
            const vec3 taken = xyz(state_[Field::angular_error][0]);
            record.errors = {record.errors.x, taken.x, taken.y, taken.z};
        }
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
        const vec3 moved = xyz(state_[Field::displacement][index]),
                   velocity = moved + xyz(state_[Field::end_excess][index]);
        StatisticsRecord record =
            particle_statistics(xyz(position), moved, velocity, share, xyz(reference_), static_cast<uint>(index));
        if (record.counts.x != 0) return record;
        for (int direction = 0; direction < 4; ++direction) record = with_spring(record, particle, direction);
        if (cloth_.bend > 0) record = with_bending(record, particle);
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

    struct Edge {
        vec3 rest{0, 0, 0}, now{0, 0, 0};
    };

    Edge edge(ivec2 from, ivec2 to) const {
        if (!inside(from) || !inside(to)) return {};
        return {xyz(cloth_.rest_shape()[at(to)]) - xyz(cloth_.rest_shape()[at(from)]),
                xyz(state_[Field::position][at(to)]) - xyz(state_[Field::position][at(from)])};
    }
    static Edge sum_of(const Edge& one, const Edge& other, float sign) {
        return {other.rest + one.rest * sign, other.now + one.now * sign};
    }

    /// Returns the shares of the springs that a particle owns, by direction; 0 for those that leave the grid.
    vec4 shares(ivec2 owner) const {
        vec4 all{0, 0, 0, 0};
        for (int direction = 0; direction < 4; ++direction) {
            const ivec2 offset = spring_directions[static_cast<std::size_t>(direction)].offset;
            if (!inside(owner) || !inside({owner.x + offset.x, owner.y + offset.y})) continue;
            component(all, direction) = state_.topology.masked()
                                            ? component(state_.topology.spring_shares()[at(owner)], direction)
                                            : border_share(owner, offset, push_.grid);
        }
        return all;
    }

    vec3 beyond(const Edge& difference, const Edge& row, const Edge& column) const {
        vec3 target{0, 0, 0};
        if (cloth_.rests_bent())
            target = rest_difference(rest_coordinates(difference.rest, Tangents(row.rest, column.rest)),
                                     Tangents(row.now, column.now), difference.now);
        return beyond_rest(difference.now, target);
    }

    StatisticsRecord with_bending(const StatisticsRecord& record, ivec2 p) const {
        const ivec2 left{p.x - 1, p.y}, up{p.x, p.y - 1}, right{p.x + 1, p.y}, below{p.x, p.y + 1},
            across{p.x + 1, p.y + 1};
        const vec4 own = shares(p);
        const float share_left = shares(left).x, share_up = shares(up).y;
        const auto if_there = [](const Edge& side, float share) { return share > 0.0f ? side : Edge{}; };
        const Edge to_left = edge(p, left), to_right = edge(p, right), to_up = edge(p, up), to_below = edge(p, below),
                   lower = edge(below, across), far = edge(right, across);
        const Edge row = sum_of(if_there(to_left, share_left), if_there(to_right, own.x), -1.0f),
                   column = sum_of(if_there(to_up, share_up), if_there(to_below, own.y), -1.0f);
        StatisticsRecord sum = add_bending(record, beyond(sum_of(to_left, to_right, 1.0f), row, column),
                                           push_.half_bend.x, bend_share(share_left, own.x));
        sum = add_bending(sum, beyond(sum_of(to_up, to_below, 1.0f), row, column), push_.half_bend.y,
                          bend_share(share_up, own.y));
        const vec3 twisted =
            beyond(sum_of(to_right, lower, -1.0f), sum_of(to_right, lower, 1.0f), sum_of(to_below, far, 1.0f));
        return add_bending(sum, twisted, push_.half_bend.z, twist_share(own, shares(right), shares(below)));
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
