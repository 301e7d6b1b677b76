#include "cloth/step_flops.h"

#include "cloth/directions.h"
#include "cloth/kernel_steps.h"

namespace drape {

namespace {

double particles_of(glsl::ivec2 grid) { return double(grid.x) * grid.y; }

double springs_of(const glsl::ExplicitPush& push) {
    const double x = push.grid.x, y = push.grid.y;
    const double diagonal = push.relative_stiffness.z == 0.0f ? 0 : 2 * (x - 1) * (y - 1);
    return (x - 1) * y + x * (y - 1) + diagonal;
}

double springs_of(const glsl::AllSpringsPush& push) {
    double count = 0;
    for (const SpringPass& pass : spring_passes(push.grid))
        if (has_direction(push, pass.direction)) count += particles_of(pass.pair_count);
    return count;
}

}  // namespace

double step_flops(const Step& step, const ClothModel& cloth) {
    const double particles = particles_of(cloth.grid.size());
    const double skipped = step.substep > 0 ? 0 : kernel_flops.advance;  // a frame's first substep does not advance X
    switch (step.kind) {
        case StepKind::force:
            return particles * (kernel_flops.force - skipped);
        case StepKind::predict:
            return particles * (kernel_flops.predict - skipped);
        case StepKind::explicit_step:
            return particles * (kernel_flops.explicit_particle - skipped) +
                   springs_of(step.push<glsl::ExplicitPush>()) * kernel_flops.explicit_spring;
        case StepKind::spring:
            return particles_of(step.push<glsl::SpringPush>().pair_count) * kernel_flops.spring;
        case StepKind::all_springs:
            return springs_of(step.push<glsl::AllSpringsPush>()) * kernel_flops.spring;
        case StepKind::line:
            return particles * (kernel_flops.line_spring + (step.iteration == 0 ? kernel_flops.line_tension : 0));
        case StepKind::advance:
            return particles * kernel_flops.advance;
        default:
            return 0;
    }
}

}  // namespace drape
