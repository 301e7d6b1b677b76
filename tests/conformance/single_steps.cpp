#include "single_steps.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "solver/host_inputs.h"
#include "solver/state_transfer.h"
#include "twin/kernels.h"
#include "twin_steps.h"

namespace drape::test {

namespace {

/// Returns the names that the pool has for what a handle sees.
std::vector<std::string> names_of(const graph::Graph& graph, graph::Handle handle) {
    const graph::Resource& resource = graph.resources()[handle.resource];
    if (resource.image.slices.empty()) return {resource.name};
    if (handle.slice != UINT32_MAX) return {resource.image.slices[handle.slice]};
    return resource.image.slices;
}

/// Returns where a slice of so many bytes begins in its image, whose slices lie below each other.
std::ptrdiff_t first_of(const graph::Resource& resource, const std::string& slice, std::size_t bytes) {
    const auto& slices = resource.image.slices;
    return (std::ranges::find(slices, slice) - slices.begin()) * static_cast<std::ptrdiff_t>(bytes);
}

/// The field in which the twin, which has no spare tension or control, keeps what the device may have in another.
Field twin_field(Field field) {
    if (field == Field::line_control_spare) return Field::line_control;
    for (std::size_t direction = 0; direction < spring_directions.size(); ++direction)
        if (field == tension_spare_of(direction)) return tension_of(direction);
    return field;
}

/// Returns the twin's bytes of a field that passes write. Its topology has the spring shares.
std::span<const std::byte> expected_of(const TwinCloth& twin, Field field) {
    return field == Field::spring_share ? std::as_bytes(std::span(twin.topology.spring_shares()))
                                        : twin.bytes(twin_field(field));
}

/// Returns whether the twin has what the device's passes hand each other in a field.
bool mirrored(const FieldRow& row) { return row.is_image() && row.life != FieldLife::device; }
/// Returns whether a field holds what the next step writes over, or what the last one left there.
bool spare(const FieldRow& row) {
    return std::ranges::find(spare_fields, row.field, &SpareField::spare) != std::end(spare_fields);
}
/// Returns whether the device keeps marks of its own in a field, which the twin has not.
bool marked(const FieldRow& row) { return row.field == Field::lifted_once || row.field == Field::lifted; }

template <class T>
std::vector<T> list_of(std::span<const std::byte> bytes) {
    std::vector<T> list(bytes.size() / sizeof(T));
    std::memcpy(list.data(), bytes.data(), bytes.size());
    return list;
}

double largest(const std::vector<glsl::vec4>& texels, double least) {
    double largest = least;
    for (const glsl::vec4& texel : texels)
        for (const float x : {texel.x, texel.y, texel.z}) largest = std::max(largest, std::abs(double{x}));
    return largest;
}

/// Returns the magnitude (m) of what a kind of step computes lengths from: edges, but places for what meets colliders,
/// and the whole cloth for what reaches through it.
double length_of(StepKind kind, const ClothModel& model, const TwinCloth& twin) {
    if (kind == StepKind::collider_edges || kind == StepKind::collide) return largest(twin[Field::position], 0);
    const double across = model.spacing[0] * model.grid.columns(), down = model.spacing[1] * model.grid.rows();
    return kind == StepKind::tether ? std::hypot(across, down) : std::max(model.spacing[0], model.spacing[1]);
}

/// Returns the least scales of a field and of its w: all but forces are lengths. What a sum lost is as uncertain as the
/// sum is, and so is a share that is left of 1.
std::pair<double, double> least_scales(Field field, const TwinCloth& twin, double length) {
    switch (field) {
        case Field::wind_force:
            return {0, 0};
        case Field::position_remainder:
            return {largest(twin[Field::position], length), 0};
        case Field::displacement_remainder:
            return {largest(twin[Field::displacement], length), 0};
        case Field::displacement:
            return {length, 1};
        default:
            return {length, length};
    }
}

void add_pair(const FieldRow& row, std::pair<double, double> least, std::span<const std::byte> device,
              std::span<const std::byte> twin, std::vector<FieldPair>& fields) {
    const std::string name(row.name);
    if (&row.element == &glsl::layout_of<float>()) {
        fields.push_back({name, list_of<float>(device), list_of<float>(twin), {}, {}, least.first});
    } else if (&row.element == &glsl::layout_of<glsl::vec4>()) {
        TexelPairs pairs(name, least.first, least.second);
        const auto ours = list_of<glsl::vec4>(device), theirs = list_of<glsl::vec4>(twin);
        for (std::size_t k = 0; k < theirs.size(); ++k)
            if (marked(row))
                pairs.add(texel(xyz(ours[k]), std::max(ours[k].w, 0.0f)), theirs[k]);
            else
                pairs.add(ours[k], theirs[k]);
        pairs.put_into(fields);
    } else {
        fields.push_back({name, {}, {}, list_of<std::uint32_t>(device), list_of<std::uint32_t>(twin)});
    }
}

/// Returns which particles lie on something, which rounding may turn: a particle that rests is as deep in a surface as
/// it may be.
FieldPair lie_on(std::span<const std::byte> device, std::span<const std::byte> twin) {
    FieldPair pair{.name = "lies on a surface"};
    for (const auto& [bytes, lie] : {std::pair{device, &pair.device_integers}, {twin, &pair.twin_integers}})
        for (const glsl::vec4& plane : list_of<glsl::vec4>(bytes))
            lie->push_back(plane.x != 0 || plane.y != 0 || plane.z != 0);
    return pair;
}

/// Returns a field of texels with the twin's where a decision was turned.
std::vector<std::byte> without_turned(const FieldPair& decision, std::vector<std::byte> device,
                                      std::span<const std::byte> twin) {
    for (std::size_t k = 0; k < decision.twin_integers.size(); ++k)
        if (decision.device_integers[k] != decision.twin_integers[k])
            std::ranges::copy(twin.subspan(k * sizeof(glsl::vec4), sizeof(glsl::vec4)),
                              device.begin() + static_cast<std::ptrdiff_t>(k * sizeof(glsl::vec4)));
    return device;
}

/// Sums up in the order of the decision that reads them.
glsl::ResidualRecord sum_of(const std::vector<glsl::ResidualRecord>& records) {
    std::array<glsl::ResidualRecord, glsl::workgroup_width> lanes{};
    for (std::size_t k = 0; k < records.size(); ++k)
        lanes[k % lanes.size()] = glsl::joined(lanes[k % lanes.size()], records[k]);
    for (std::size_t stride = lanes.size() / 2; stride > 0; stride /= 2)
        for (std::size_t lane = 0; lane < stride; ++lane) lanes[lane] = glsl::joined(lanes[lane], lanes[lane + stride]);
    return lanes.front();
}

}  // namespace

SingleSteps::SingleSteps(const vulkan::Device& device, const SimulationModel& model, const Kernels& kernels, Twin& twin)
    : device_(device), model_(model), twin_(twin), solver_(device, model, kernels), slots_(device) {
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth)
        solver_.layout().topologies[cloth] = twin.topology(cloth);
    find_singles();
    std::vector<std::pair<const graph::Graph*, const graph::Plan*>> plans;
    for (const auto& single : singles_)
        if (single->runs()) plans.emplace_back(&single->graph, &single->plan);
    pool_ = std::make_unique<graph::ResourcePool>(device, plans);
    for (const auto& single : singles_)
        if (single->runs())
            single->recorded =
                std::make_unique<graph::RecordedPlan>(single->graph, single->plan, *pool_, graph::TimestampMode::none);
    upload_start(solver_.layout(), *pool_);
    if (model.self_contact) contact_ = std::make_unique<ContactMirror>(device, *model.self_contact, *pool_);
}

void SingleSteps::find_singles() {
    const std::vector<Step> steps = solver_.steps();
    all_kernels_ = std::ranges::all_of(steps, [](const Step& step) { return step.kernel == Kernel::plain; });
    std::vector<DeviceStep> device;
    for (const Step& step : steps) device.push_back({step, solver_.layout().cloths_of(step)});
    const std::vector<std::vector<Step>> twin = twin_steps(twin_.steps(), device, model_.cloths.size());
    for (std::size_t k = 0; k < device.size(); ++k) {
        const auto& [step, cloths] = device[k];
        const bool turned = all_kernels_ && k > 0 && device[k - 1].step.kind == StepKind::explicit_step;
        if (step.kind != StepKind::advance || !turned) singles_.push_back(std::make_unique<Single>());
        Single& single = *singles_.back();
        single.steps.push_back(step);
        single.cloths = cloths;
        single.twin.insert(single.twin.end(), twin[k].begin(), twin[k].end());
    }
    for (const auto& single : singles_)
        if (is_wanted(single->step())) build(*single);
}

bool SingleSteps::is_wanted(const Step& step) const {
    const std::uint32_t count = model_.scene.solver.substeps;
    const bool of_few = count <= 4 || step.substep < 2 || step.substep + 1 >= count;
    return of_few && (all_kernels_ || step.kernel != Kernel::plain);
}

void SingleSteps::build(Single& single) {
    solver_.declare(single.graph, {.statistics = true, .inspection = true});
    single.before = solver_.cloths();
    for (const Step& step : single.steps) solver_.add_step(single.graph, step);
    single.after = solver_.cloths();
    single.plan = graph::make_plan(single.graph);
    for (const graph::Pass& pass : single.graph.passes())
        for (const graph::Use& use : pass.uses)
            for (const std::string& name : names_of(single.graph, use.handle)) {
                single.used.insert(name);
                if (graph::is_write(use.access)) single.written.insert(name);
            }
}

void SingleSteps::upload(const Single& single) {
    for (const std::size_t cloth : single.cloths)
        for (const FieldRow& row : cloth_fields()) {
            const graph::Handle handle = single.before[cloth][row.field];
            if (!handle.valid() || !mirrored(row) || marked(row)) continue;
            const std::span<const std::byte> bytes = twin_.cloth(cloth).bytes(twin_field(row.field));
            for (const std::string& name : names_of(single.graph, handle))
                if (single.used.contains(name) && !bytes.empty()) put(single, handle, name, bytes);
        }
    if (contact_) contact_->upload(single.step(), single.used, twin_.contact());
}

void SingleSteps::put(const Single& single, graph::Handle handle, const std::string& name,
                      std::span<const std::byte> bytes) {
    std::vector<std::byte>& held = held_[name];
    if (std::ranges::equal(held, bytes)) return;
    held.assign(bytes.begin(), bytes.end());
    const graph::Resource& resource = single.graph.resources()[handle.resource];
    const vulkan::Image& image = pool_->image(resource.name);
    if (resource.image.slices.empty()) return vulkan::upload(device_, image, bytes);
    std::vector<std::byte> whole(bytes.size() * resource.image.slices.size());
    vulkan::download(device_, image, whole);
    std::ranges::copy(bytes, whole.begin() + first_of(resource, name, bytes.size()));
    vulkan::upload(device_, image, whole);
}

void SingleSteps::get(const Single& single, graph::Handle handle, const std::string& name,
                      std::vector<std::byte>& bytes) const {
    const graph::Resource& resource = single.graph.resources()[handle.resource];
    const vulkan::Image& image = pool_->image(resource.name);
    if (resource.image.slices.empty()) return vulkan::download(device_, image, bytes);
    std::vector<std::byte> whole(bytes.size() * resource.image.slices.size());
    vulkan::download(device_, image, whole);
    std::copy_n(whole.begin() + first_of(resource, name, bytes.size()), bytes.size(), bytes.begin());
}

std::vector<FieldPair> SingleSteps::fields(const Single& single) {
    std::vector<FieldPair> fields;
    for (const std::size_t cloth : single.cloths) {
        FieldPair lies;
        for (const FieldRow& row : cloth_fields()) {
            const graph::Handle handle = single.after[cloth][row.field];
            if (!handle.valid() || !mirrored(row) || spare(row)) continue;
            const std::span<const std::byte> expected = expected_of(twin_.cloth(cloth), row.field);
            const std::string name = names_of(single.graph, handle).front();
            if (!single.written.contains(name) || expected.empty()) continue;
            std::vector<std::byte>& bytes = held_[name];
            bytes.resize(expected.size());
            get(single, handle, name, bytes);
            const double length = length_of(single.step().kind, model_.cloths[cloth], twin_.cloth(cloth));
            if (single.step().kind == StepKind::collide && row.field == Field::support)
                fields.push_back(lies = lie_on(bytes, expected));
            const bool of_support = row.field == Field::support || row.field == Field::support_grip;
            add_pair(row, least_scales(row.field, twin_.cloth(cloth), length),
                     of_support ? without_turned(lies, bytes, expected) : bytes, expected, fields);
        }
        add_decision(single, cloth, fields);
    }
    if (contact_) contact_->add_fields(single.step(), single.written, twin_.contact(), fields);
    return fields;
}

void SingleSteps::add_decision(const Single& single, std::size_t cloth, std::vector<FieldPair>& fields) const {
    const TwinCloth& twin = twin_.cloth(cloth);
    const auto list = [&]<class T>(Field field, std::vector<T>& values) {
        const std::string name = resource_name(model_.cloths[cloth], row_of(field));
        if (!single.written.contains(name)) return false;
        const vulkan::Buffer& buffer = pool_->buffer(name);
        values.resize(buffer.description().byte_count / sizeof(T));
        vulkan::download(device_, buffer, std::as_writable_bytes(std::span(values)));
        return true;
    };
    if (std::vector<glsl::ResidualRecord> records; list(Field::residuals, records)) {
        const glsl::ResidualRecord sum = sum_of(records);
        // The errors are uncertain at the magnitude of the edges, however small their squares are.
        const double scale = std::sqrt(double{twin.residual.squares} * twin.residual.count);
        fields.push_back({"residuals", {sum.squares}, {twin.residual.squares}, {}, {}, scale});
        fields.push_back({"residuals.count", {}, {}, {sum.count}, {twin.residual.count}});
    }
    if (std::vector<glsl::uvec4> sizes; list(Field::iterations, sizes))
        fields.push_back({"iterations",
                          {},
                          {},
                          {sizes.back().x, sizes.front().x > 0 ? 1u : 0u},
                          {twin.iteration_count, twin.iterates ? 1u : 0u}});
}

void SingleSteps::run_frame(std::uint32_t frame, const Visit& visit) {
    write_inputs(solver_.layout(), *pool_, 0, frame, model_);
    FrameInputs inputs = frame_inputs(model_, frame);
    for (const auto& single : singles_) {
        if (single->runs()) run(*single);
        for (const Step& step : single->twin) twin_.run_step(step, inputs);
        if (single->runs()) visit(single->steps, fields(*single));
    }
}

void SingleSteps::run(Single& single) {
    upload(single);
    slots_.submit(0, single.recorded->commands(0));
    slots_.wait(0);
    for (const std::string& name : single.written) held_.erase(name);
}

}  // namespace drape::test
