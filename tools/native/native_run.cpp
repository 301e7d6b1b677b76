#include "native/native_run.h"

#include <algorithm>
#include <array>
#include <barrier>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <thread>

#include "native/native_kernels.h"

namespace drape::native {

using namespace glsl;

namespace {

/// Who of how many, and where they wait for each other.
struct Worker {
    int index, count;
    std::barrier<>* barrier;

    void wait() const {
        if (barrier) barrier->arrive_and_wait();
    }
    Rows share(int rows) const { return {rows * index / count, rows * (index + 1) / count}; }
};

constexpr std::ptrdiff_t margin = 16;  // floats, before the first row and behind each

}  // namespace

class NativeRun::Sheet {
  public:
    Sheet(const ClothModel& cloth, const Kernels& kernels, int worker_count)
        : cloth_(cloth), kernels_(kernels), wrong_lines_(static_cast<std::size_t>(worker_count)) {
        const ivec2 grid = cloth.grid.size();
        view_.columns = grid.x;
        view_.rows = grid.y;
        // Not a power of two, whose rows would share the first cache's lines.
        view_.pitch = view_.whole_vectors() + margin;
        for (Vectors* field : {&view_.position, &view_.displacement, &view_.position_remainder,
                               &view_.displacement_remainder, &view_.displacement_before, &view_.velocity_excess})
            *field = {field_memory(), field_memory(), field_memory()};
        view_.weight = field_memory();
        for (std::size_t k = 0; k < spring_directions.size(); ++k)
            view_.tension[k] = cloth.scheme.carries_tension[k] ? field_memory() : nullptr;
        place_particles();
        const std::size_t workers = static_cast<std::size_t>(worker_count);
        if (cloth.scheme.line_scratch)
            lines_.assign(workers, std::vector<LineParticles>(std::max(grid.x, grid.y) + std::size_t{1}));
        if (cloth.scheme.spare_state)
            for (std::size_t k = 0; k < workers; ++k) explicit_.push_back(explicit_scratch());
    }

    void run(const Step& step, const Worker& worker) {
        const Rows rows = worker.share(view_.rows);
        const bool advance = step.substep > 0;
        switch (step.kind) {
            case StepKind::predict:
                if (worker.index == 0) control(step.push<PredictPush>().most_wrong);
                worker.wait();
                kernels_.predict_rows(view_, step.push<PredictPush>(), advance, is_bdf2(), rows);
                return worker.wait();
            case StepKind::force:
                kernels_.force_rows(view_, step.push<ForcePush>(), advance, rows);
                return worker.wait();
            case StepKind::explicit_step:
                return explicit_step(step.push<ExplicitPush>(), advance, rows, worker);
            case StepKind::line:
                return line(step, worker);
            case StepKind::spring: {
                const auto& push = step.push<SpringPush>();
                kernels_.spring_rows(view_, push, worker.share(push.pair_count.y));
                return worker.wait();
            }
            case StepKind::advance:
                kernels_.advance_rows(view_, rows);
                return worker.wait();
            default:
                throw std::invalid_argument("a step without a native kernel");
        }
    }

    std::vector<vec3> rows_of(const Vectors& field) const {
        std::vector<vec3> all;
        for (int y = 0; y < view_.rows; ++y)
            for (int x = 0; x < view_.columns; ++x) {
                const std::ptrdiff_t at = view_.place(x, y);
                all.push_back({field.x[at], field.y[at], field.z[at]});
            }
        return all;
    }
    const SheetView& view() const { return view_; }

  private:
    /// Zeros, with margins. Begins at a line of the cache, and not at the same place of a page as others, which would
    /// drive each other out of the first cache.
    float* zeros(std::size_t count) {
        constexpr std::size_t line = 64 / sizeof(float);
        const std::size_t shift = memory_.size() % 13 * 5 * line;
        memory_.emplace_back(count + 2 * margin + shift + line);
        void* place = memory_.back().data() + margin + shift;
        std::size_t space = (count + line) * sizeof(float);
        return static_cast<float*>(std::align(64, count * sizeof(float), place, space));
    }
    float* field_memory() { return zeros(static_cast<std::size_t>(view_.pitch * view_.rows)); }

    void place_particles() {
        const std::vector<vec4> start = cloth_.start_displacement();
        for (int y = 0; y < view_.rows; ++y)
            for (int x = 0; x < view_.columns; ++x) {
                const std::size_t i = static_cast<std::size_t>(y) * cloth_.grid.columns() + static_cast<std::size_t>(x);
                const std::ptrdiff_t at = view_.place(x, y);
                const vec4 &position = cloth_.position[i], &displacement = start[i];
                put(view_.position, at, position);
                put(view_.displacement, at, displacement);
                view_.weight[at] = position.w;
            }
    }
    static void put(const Vectors& field, std::ptrdiff_t at, const vec4& value) {
        field.x[at] = value.x;
        field.y[at] = value.y;
        field.z[at] = value.z;
    }

    ExplicitScratch explicit_scratch() {
        const auto& push = std::get<ExplicitPush>(cloth_.scheme.prediction.at(0).constants);
        const auto count = static_cast<std::size_t>(view_.whole_vectors());
        ExplicitScratch scratch;
        const auto vectors = [&] { return Vectors{zeros(count), zeros(count), zeros(count)}; };
        for (Vectors& row : scratch.above) row = vectors();
        for (Vectors& row : scratch.below) row = vectors();
        scratch.along = vectors();
        scratch.next_position = vectors();
        scratch.next_displacement = vectors();
        const float along[] = {push.relative_stiffness.x, push.relative_stiffness.x * 0.5f, push.relative_stiffness.y,
                               push.relative_stiffness.z};
        for (std::size_t k = 0; k < std::size(along); ++k) {
            scratch.stiffness[k] = zeros(count);
            std::fill_n(scratch.stiffness[k], view_.columns, along[k]);
        }
        scratch.stiffness[2][0] = scratch.stiffness[2][view_.columns - 1] = push.relative_stiffness.y * 0.5f;
        return scratch;
    }

    void explicit_step(const ExplicitPush& push, bool advance, Rows rows, const Worker& worker) {
        const ExplicitScratch& scratch = explicit_[static_cast<std::size_t>(worker.index)];
        kernels_.prepare_explicit(view_, push, advance, rows, scratch);
        worker.wait();
        kernels_.explicit_rows(view_, push, advance, rows, scratch);
        worker.wait();
    }

    bool is_bdf2() const { return control_.order == 2; }
    void control(std::uint32_t most_wrong);
    void line(const Step& step, const Worker& worker) {
        const auto& push = step.push<LinePush>();
        const auto index = static_cast<std::size_t>(worker.index);
        Rows blocks = worker.share((push.line_count + line_lanes - 1) / line_lanes);
        wrong_lines_[index] +=
            kernels_.solve_lines(view_, push, step.iteration == 0, is_bdf2(), blocks.first * line_lanes,
                                 std::min(blocks.last * line_lanes, push.line_count), lines_[index].data());
        worker.wait();
    }

    struct Control {
        uint order = 0, hold = 0;
    };

    const ClothModel& cloth_;
    const Kernels& kernels_;
    SheetView view_{};
    std::vector<std::vector<float>> memory_;
    std::vector<std::vector<LineParticles>> lines_;  ///< by worker
    std::vector<ExplicitScratch> explicit_;          ///< by worker
    std::vector<std::uint32_t> wrong_lines_;         ///< of the substep, by worker
    Control control_;
};

/// As include/bdf2.h has it.
void NativeRun::Sheet::control(std::uint32_t most_wrong) {
    const std::uint32_t wrong = std::reduce(wrong_lines_.begin(), wrong_lines_.end());
    control_.hold = control_.order == 0 ? line_hold_start : control_.hold > 0 ? control_.hold - 1 : 0;
    if (wrong > most_wrong) control_.hold = line_hold_count;
    control_.order = control_.hold > 0 ? 1 : 2;
    std::ranges::fill(wrong_lines_, 0u);
}

NativeRun::NativeRun(const SimulationModel& model, NativeWay way)
    : worker_count_(way.worker_count), steps_(model.cloths.size()) {
    const int sharing = model.cloths.size() > 1 ? 1 : worker_count_;
    for (const ClothModel& cloth : model.cloths) {
        const PerDirection<double>& springs = cloth.stiffness_constant.spring;
        if (cloth.starts_masked || cloth.bend > 0 || std::ranges::count(springs, 0) > 0)
            throw std::invalid_argument("a cloth without a native kernel");
        if (!cloth.scheme.line_scratch && std::ranges::count(cloth.scheme.carries_tension, true) > 0)
            throw std::invalid_argument("iterations without a native kernel");
        sheets_.push_back(std::make_unique<Sheet>(cloth, way.vectors ? vector_kernels() : scalar_kernels(), sharing));
    }
    constexpr std::array known{StepKind::predict, StepKind::force,  StepKind::explicit_step,
                               StepKind::line,    StepKind::spring, StepKind::advance};
    for (const Step& step : frame_steps(model)) {
        if (std::ranges::find(known, step.kind) == known.end() || step.conditional)
            throw std::invalid_argument("a step without a native kernel");
        for (std::size_t cloth = 0; cloth < steps_.size(); ++cloth)
            if (step.cloth == cloth || step.cloth == all_cloths) steps_[cloth].push_back(step);
    }
}

NativeRun::~NativeRun() = default;

std::vector<double> NativeRun::run(int frame_count) {
    using Clock = std::chrono::steady_clock;
    std::barrier<> barrier(worker_count_);
    const Worker alone{0, 1, nullptr};
    const bool shares_cloths = sheets_.size() > 1;
    std::vector<double> milliseconds;
    const auto work = [&](int index) {
        const Worker worker{index, worker_count_, worker_count_ > 1 ? &barrier : nullptr};
        const std::size_t first = shares_cloths ? static_cast<std::size_t>(index) : 0;
        const std::size_t stride = shares_cloths ? static_cast<std::size_t>(worker_count_) : 1;
        worker.wait();
        Clock::time_point before = Clock::now();
        for (int frame = 0; frame < frame_count; ++frame) {
            for (std::size_t cloth = first; cloth < sheets_.size(); cloth += stride)
                for (const Step& step : steps_[cloth]) sheets_[cloth]->run(step, shares_cloths ? alone : worker);
            worker.wait();
            const Clock::time_point now = Clock::now();
            if (index == 0) milliseconds.push_back(std::chrono::duration<double, std::milli>(now - before).count());
            before = now;
        }
    };
    std::vector<std::jthread> others;
    for (int index = 1; index < worker_count_; ++index) others.emplace_back(work, index);
    work(0);
    return milliseconds;
}

std::vector<vec3> NativeRun::positions(std::size_t cloth) const {
    return sheets_[cloth]->rows_of(sheets_[cloth]->view().position);
}

std::vector<vec3> NativeRun::displacements(std::size_t cloth) const {
    return sheets_[cloth]->rows_of(sheets_[cloth]->view().displacement);
}

std::vector<float> NativeRun::tension(std::size_t cloth, std::size_t direction) const {
    const SheetView& view = sheets_[cloth]->view();
    std::vector<float> all;
    for (int y = 0; y < view.rows; ++y)
        for (int x = 0; x < view.columns; ++x) all.push_back(view.tension[direction][view.place(x, y)]);
    return all;
}

}  // namespace drape::native
