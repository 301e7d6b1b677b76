#include "passes/struct_layouts.h"

#include <cstddef>

#include "shared/cut_types.h"
#include "shared/line_types.h"
#include "shared/residual_types.h"
#include "shared/simulation_types.h"
#include "shared/statistics_types.h"
#include "shared/tether_types.h"

namespace drape::layouts {

using namespace glsl;

namespace {

constexpr vulkan::MemberLayout spring_push_members[] = {
    {"grid", offsetof(SpringPush, grid)},
    {"pair_count", offsetof(SpringPush, pair_count)},
    {"offset", offsetof(SpringPush, offset)},
    {"parity_axis", offsetof(SpringPush, parity_axis)},
    {"parity", offsetof(SpringPush, parity)},
    {"rest_length", offsetof(SpringPush, rest_length)},
    {"compliance", offsetof(SpringPush, compliance)},
    {"channel", offsetof(SpringPush, channel)},
    {"first_iteration", offsetof(SpringPush, first_iteration)},
};
constexpr vulkan::MemberLayout force_push_members[] = {
    {"grid", offsetof(ForcePush, grid)},
    {"damping_loss", offsetof(ForcePush, damping_loss)},
    {"force_step", offsetof(ForcePush, force_step)},
    {"gravity_step", offsetof(ForcePush, gravity_step)},
};
constexpr vulkan::MemberLayout explicit_push_members[] = {
    {"grid", offsetof(ExplicitPush, grid)},
    {"damping_loss", offsetof(ExplicitPush, damping_loss)},
    {"force_step", offsetof(ExplicitPush, force_step)},
    {"gravity_step", offsetof(ExplicitPush, gravity_step)},
    {"rest_length", offsetof(ExplicitPush, rest_length)},
    {"stiffness", offsetof(ExplicitPush, stiffness)},
    {"bend", offsetof(ExplicitPush, bend)},
    {"strain_damping", offsetof(ExplicitPush, strain_damping)},
    {"twist", offsetof(ExplicitPush, twist)},
};
constexpr vulkan::MemberLayout bend_push_members[] = {
    {"grid", offsetof(BendPush, grid)},       {"element_count", offsetof(BendPush, element_count)},
    {"axis", offsetof(BendPush, axis)},       {"colour", offsetof(BendPush, colour)},
    {"channel", offsetof(BendPush, channel)}, {"compliance", offsetof(BendPush, compliance)},
};
constexpr vulkan::MemberLayout line_push_members[] = {
    {"grid", offsetof(LinePush, grid)},
    {"step", offsetof(LinePush, step)},
    {"line_count", offsetof(LinePush, line_count)},
    {"particle_count", offsetof(LinePush, particle_count)},
    {"seam", offsetof(LinePush, seam)},
    {"channel", offsetof(LinePush, channel)},
    {"rest_length", offsetof(LinePush, rest_length)},
    {"compliance", offsetof(LinePush, compliance)},
    {"compliance_bdf2", offsetof(LinePush, compliance_bdf2)},
    {"followed", offsetof(LinePush, followed)},
    {"followed_bdf2", offsetof(LinePush, followed_bdf2)},
    {"first_iteration", offsetof(LinePush, first_iteration)},
    {"unused", offsetof(LinePush, unused)},
};
constexpr vulkan::MemberLayout predict_push_members[] = {
    {"grid", offsetof(PredictPush, grid)},
    {"loss", offsetof(PredictPush, loss)},
    {"force_step", offsetof(PredictPush, force_step)},
    {"weight", offsetof(PredictPush, weight)},
    {"gravity_step", offsetof(PredictPush, gravity_step)},
    {"gravity_step_bdf2", offsetof(PredictPush, gravity_step_bdf2)},
};
constexpr vulkan::MemberLayout particle_tethers_members[] = {
    {"anchor_a", offsetof(ParticleTethers, anchor_a)},
    {"anchor_b", offsetof(ParticleTethers, anchor_b)},
    {"length_a", offsetof(ParticleTethers, length_a)},
    {"length_b", offsetof(ParticleTethers, length_b)},
};
constexpr vulkan::MemberLayout twist_push_members[] = {
    {"element_count", offsetof(TwistPush, element_count)},
    {"first", offsetof(TwistPush, first)},
    {"compliance", offsetof(TwistPush, compliance)},
};
constexpr vulkan::MemberLayout wind_push_members[] = {
    {"grid", offsetof(WindPush, grid)},
    {"substep", offsetof(WindPush, substep)},
    {"inverse_step", offsetof(WindPush, inverse_step)},
    {"drag_coefficient", offsetof(WindPush, drag_coefficient)},
    {"lift_coefficient", offsetof(WindPush, lift_coefficient)},
};
constexpr vulkan::MemberLayout collision_push_members[] = {
    {"first", offsetof(CollisionPush, first)},
    {"count", offsetof(CollisionPush, count)},
    {"contact", offsetof(CollisionPush, contact)},
    {"grid", offsetof(CollisionPush, grid)},
};
constexpr vulkan::MemberLayout pin_push_members[] = {
    {"particle_count", offsetof(PinPush, particle_count)},
    {"motion_first", offsetof(PinPush, motion_first)},
};
constexpr vulkan::MemberLayout tension_push_members[] = {
    {"grid", offsetof(TensionPush, grid)},
    {"rest_length", offsetof(TensionPush, rest_length)},
    {"used_share", offsetof(TensionPush, used_share)},
    {"strain_damping", offsetof(TensionPush, strain_damping)},
    {"unused", offsetof(TensionPush, unused)},
};
constexpr vulkan::MemberLayout grid_push_members[] = {
    {"grid", offsetof(GridPush, grid)},
};
constexpr vulkan::MemberLayout residual_push_members[] = {
    {"grid", offsetof(ResidualPush, grid)},
    {"rest_length", offsetof(ResidualPush, rest_length)},
};
constexpr vulkan::MemberLayout iteration_push_members[] = {
    {"partial_count", offsetof(IterationPush, partial_count)},
    {"squared_tolerance", offsetof(IterationPush, squared_tolerance)},
    {"first_check", offsetof(IterationPush, first_check)},
    {"substep_count", offsetof(IterationPush, substep_count)},
};
constexpr vulkan::MemberLayout residual_record_members[] = {
    {"squares", offsetof(ResidualRecord, squares)},
    {"count", offsetof(ResidualRecord, count)},
};
constexpr vulkan::MemberLayout statistics_push_members[] = {
    {"rest_length", offsetof(StatisticsPush, rest_length)},
    {"half_stiffness", offsetof(StatisticsPush, half_stiffness)},
    {"reference", offsetof(StatisticsPush, reference)},
    {"collider_first", offsetof(StatisticsPush, collider_first)},
    {"collider_count", offsetof(StatisticsPush, collider_count)},
    {"grid", offsetof(StatisticsPush, grid)},
};
constexpr vulkan::MemberLayout statistics_sum_push_members[] = {
    {"partial_count", offsetof(StatisticsSumPush, partial_count)},
};
constexpr vulkan::MemberLayout statistics_record_members[] = {
    {"squares", offsetof(StatisticsRecord, squares)}, {"moments", offsetof(StatisticsRecord, moments)},
    {"strains", offsetof(StatisticsRecord, strains)}, {"extents", offsetof(StatisticsRecord, extents)},
    {"errors", offsetof(StatisticsRecord, errors)},   {"counts", offsetof(StatisticsRecord, counts)},
};
constexpr vulkan::MemberLayout collider_members[] = {
    {"pose_x", offsetof(Collider, pose_x)},     {"pose_y", offsetof(Collider, pose_y)},
    {"pose_z", offsetof(Collider, pose_z)},     {"change_x", offsetof(Collider, change_x)},
    {"change_y", offsetof(Collider, change_y)}, {"change_z", offsetof(Collider, change_z)},
    {"shape", offsetof(Collider, shape)},
};
constexpr vulkan::MemberLayout pinned_particle_members[] = {
    {"rest", offsetof(PinnedParticle, rest)},
    {"index", offsetof(PinnedParticle, index)},
};
constexpr vulkan::MemberLayout pin_motion_members[] = {
    {"row_x", offsetof(PinMotion, row_x)},
    {"row_y", offsetof(PinMotion, row_y)},
    {"row_z", offsetof(PinMotion, row_z)},
    {"held", offsetof(PinMotion, held)},
};
constexpr vulkan::MemberLayout cut_push_members[] = {
    {"grid", offsetof(CutPush, grid)},
    {"triangle_count", offsetof(CutPush, triangle_count)},
    {"unused", offsetof(CutPush, unused)},
};
constexpr vulkan::MemberLayout cutter_triangle_members[] = {
    {"a", offsetof(CutterTriangle, a)},
    {"b", offsetof(CutterTriangle, b)},
    {"c", offsetof(CutterTriangle, c)},
};
constexpr vulkan::MemberLayout cut_vertex_members[] = {
    {"particles", offsetof(CutVertex, particles)},
    {"weights", offsetof(CutVertex, weights)},
    {"offset", offsetof(CutVertex, offset)},
    {"material", offsetof(CutVertex, material)},
};

}  // namespace

const vulkan::StructLayout spring_push{"SpringPush", sizeof(SpringPush), spring_push_members};
const vulkan::StructLayout force_push{"ForcePush", sizeof(ForcePush), force_push_members};
const vulkan::StructLayout explicit_push{"ExplicitPush", sizeof(ExplicitPush), explicit_push_members};
const vulkan::StructLayout bend_push{"BendPush", sizeof(BendPush), bend_push_members};
const vulkan::StructLayout line_push{"LinePush", sizeof(LinePush), line_push_members};
const vulkan::StructLayout predict_push{"PredictPush", sizeof(PredictPush), predict_push_members};
const vulkan::StructLayout particle_tethers{"ParticleTethers", sizeof(ParticleTethers), particle_tethers_members};
const vulkan::StructLayout twist_push{"TwistPush", sizeof(TwistPush), twist_push_members};
const vulkan::StructLayout wind_push{"WindPush", sizeof(WindPush), wind_push_members};
const vulkan::StructLayout collision_push{"CollisionPush", sizeof(CollisionPush), collision_push_members};
const vulkan::StructLayout pin_push{"PinPush", sizeof(PinPush), pin_push_members};
const vulkan::StructLayout tension_push{"TensionPush", sizeof(TensionPush), tension_push_members};
const vulkan::StructLayout grid_push{"GridPush", sizeof(GridPush), grid_push_members};
const vulkan::StructLayout residual_push{"ResidualPush", sizeof(ResidualPush), residual_push_members};
const vulkan::StructLayout iteration_push{"IterationPush", sizeof(IterationPush), iteration_push_members};
const vulkan::StructLayout residual_record{"ResidualRecord", sizeof(ResidualRecord), residual_record_members};
const vulkan::StructLayout statistics_push{"StatisticsPush", sizeof(StatisticsPush), statistics_push_members};
const vulkan::StructLayout statistics_sum_push{"StatisticsSumPush", sizeof(StatisticsSumPush),
                                               statistics_sum_push_members};
const vulkan::StructLayout statistics_record{"StatisticsRecord", sizeof(StatisticsRecord), statistics_record_members};
const vulkan::StructLayout collider{"Collider", sizeof(Collider), collider_members};
const vulkan::StructLayout pinned_particle{"PinnedParticle", sizeof(PinnedParticle), pinned_particle_members};
const vulkan::StructLayout pin_motion{"PinMotion", sizeof(PinMotion), pin_motion_members};
const vulkan::StructLayout cut_push{"CutPush", sizeof(CutPush), cut_push_members};
const vulkan::StructLayout cutter_triangle{"CutterTriangle", sizeof(CutterTriangle), cutter_triangle_members};
const vulkan::StructLayout cut_vertex{"CutVertex", sizeof(CutVertex), cut_vertex_members};

}  // namespace drape::layouts
