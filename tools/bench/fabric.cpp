#include "drape/fabric.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/vectors.h"
#include "bench/benchmarks.h"
#include "drape/simulation.h"
#include "run/run.h"

namespace drape::bench {

namespace {

constexpr double cloth_radius = 0.15, disc_radius = 0.09, gravity = 9.81;

/// Drape coefficients, %, that engine/docs/fabrics.md cites.
struct PublishedDrape {
    std::string_view fabric;
    double least, most;
};
constexpr PublishedDrape published_drapes[] = {{"leather", 47, 70}};

/// Returns a scene of one cloth of the fabric, which comes to rest within these seconds by its damping, 1/s.
SceneDescription at_rest(const Fabric& fabric, double seconds, double damping) {
    SceneDescription scene;
    scene.time.frame_count = static_cast<std::uint32_t>(seconds * scene.time.fps) + 1;
    scene.solver.estimate_error = false;
    Cloth& cloth = scene.cloths.emplace_back();
    cloth.name = fabric.name;
    set_fabric(cloth, fabric);
    cloth.damping = damping;
    return scene;
}

Pin held(const IndexBox& box) {
    Pin pin;
    pin.particles = box;
    return pin;
}

/// Calls `each(row, first, last)` for every row of `count` with the first and last index whose place, in units of the
/// spacing from the middle, lies within `radius`.
template <class Each>
void for_rows_within(double radius, std::uint32_t count, const Each& each) {
    const double middle = (count - 1) / 2.0;
    for (std::uint32_t row = 0; row < count; ++row) {
        const double half = std::sqrt(std::max(0.0, radius * radius - (row - middle) * (row - middle)));
        if (std::abs(row - middle) > radius) continue;
        const auto first = static_cast<std::uint32_t>(std::max(0.0, std::ceil(middle - half)));
        const auto last = std::min(count - 1, static_cast<std::uint32_t>(std::floor(middle + half)));
        if (first <= last) each(row, first, last);
    }
}

/// Leaves of a square cloth the cells whose middle lies within `radius` (in spacings).
void cut_round(Cloth& cloth, double radius) {
    const std::uint32_t cells = cloth.grid[0] - 1;
    std::vector<bool> whole(cells);
    for_rows_within(radius, cells, [&](std::uint32_t row, std::uint32_t first, std::uint32_t last) {
        whole[row] = true;
        if (first > 0) cloth.holes.push_back({{0, row}, {first, row + 1}});
        if (last + 1 < cells) cloth.holes.push_back({{last + 1, row}, {cells, row + 1}});
    });
    for (std::uint32_t row = 0; row < cells; ++row)
        if (!whole[row]) cloth.holes.push_back({{0, row}, {cells, row + 1}});
}

/// Cusick's drapemeter: a round cloth, clamped between two discs. Two held particles clamp the middle of their link, so
/// the held ones go on for half a link beyond the disc.
SceneDescription drapemeter(const Fabric& fabric, std::uint32_t particles, double degrees) {
    SceneDescription scene = at_rest(fabric, 4, 3);
    Cloth& cloth = scene.cloths[0];
    const double spacing = 2 * cloth_radius / (particles - 1), angle = degrees * std::numbers::pi / 180;
    cloth.grid = {particles, particles};
    cloth.size = {2 * cloth_radius, 2 * cloth_radius};
    cloth.placement.u = {std::cos(angle), 0, std::sin(angle)};
    cloth.placement.v = {-std::sin(angle), 0, std::cos(angle)};
    cloth.placement.origin = times(-cloth_radius, plus(cloth.placement.u, cloth.placement.v));
    cloth.placement.jitter = 1e-4;
    cut_round(cloth, cloth_radius / spacing);
    for_rows_within(disc_radius / spacing + 0.5, particles,
                    [&](std::uint32_t row, std::uint32_t first, std::uint32_t last) {
                        cloth.pins.push_back(held({{first, row}, {last, row}}));
                    });
    return scene;
}

/// The shadow of a cloth, from above.
class Shadow {
  public:
    void add(const std::array<Vec3, 3>& corners) {
        double low[2]{1e9, 1e9}, high[2]{-1e9, -1e9};
        for (const Vec3& corner : corners)
            for (std::size_t k = 0; k < 2; ++k) {
                low[k] = std::min(low[k], corner[2 * k]);
                high[k] = std::max(high[k], corner[2 * k]);
            }
        for (int y = pixel(low[1]); y <= pixel(high[1]); ++y)
            for (int x = pixel(low[0]); x <= pixel(high[0]); ++x)
                if (covers(corners, place(x), place(y))) covered_[square(x, y)] = true;
    }
    double area() const { return static_cast<double>(std::ranges::count(covered_, true)) * step * step; }
    /// Counts where the outline goes out again, by more than 4 mm.
    int folds() const {
        constexpr int directions = 180;
        constexpr double least_height = 0.004;
        std::array<double, directions> radius{};
        for (int y = 0; y < width; ++y)
            for (int x = 0; x < width; ++x) {
                if (!covered_[square(x, y)]) continue;
                const double turn = std::atan2(place(y), place(x)) / (2 * std::numbers::pi) + 0.5;
                double& farthest = radius[static_cast<std::size_t>(std::min(int(turn * directions), directions - 1))];
                farthest = std::max(farthest, std::hypot(place(x), place(y)));
            }
        int count = 0;
        double turned = radius[0];
        bool rises = false;
        // The second round counts, since the first must find out whether the outline rises.
        for (int k = 0; k < 2 * directions; ++k) {
            const double now = radius[static_cast<std::size_t>(k % directions)];
            if (rises ? now > turned : now < turned) turned = now;
            if (rises ? now < turned - least_height : now > turned + least_height) {
                rises = !rises;
                turned = now;
                if (rises && k >= directions) ++count;
            }
        }
        return count;
    }

  private:
    static constexpr int width = 640, middle = width / 2;
    static constexpr double step = 0.0005;  // m
    static int pixel(double at) { return std::clamp(int(std::floor(at / step)) + middle, 0, width - 1); }
    static double place(int pixel) { return (pixel - middle + 0.5) * step; }
    static std::size_t square(int x, int y) { return std::size_t(y) * width + std::size_t(x); }
    static bool covers(const std::array<Vec3, 3>& corners, double x, double z) {
        bool left = true, right = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 &a = corners[k], &b = corners[(k + 1) % 3];
            const double side = (b[0] - a[0]) * (z - a[2]) - (b[2] - a[2]) * (x - a[0]);
            left = left && side >= 0;
            right = right && side <= 0;
        }
        return left || right;
    }
    std::vector<bool> covered_ = std::vector<bool>(std::size_t{width} * width);
};

std::vector<Vec3> last_positions(const BenchRequest& request, const SceneDescription& scene, const Device& device,
                                 const std::function<void(const Simulation&)>& start = {}) {
    Simulation simulation(scene, {.keep_promises = false}, device);
    if (start) start(simulation);
    const std::uint32_t last = scene.time.frame_count - 1;
    std::vector<Vec3> positions;
    const bool complete = simulation.run(
        last, [&](std::uint32_t frame) { return frame == last; },
        [&](const FinishedFrame& frame) {
            const std::span<const float> all = frame.positions[0];
            for (std::size_t i = 0; i + 3 < all.size(); i += 4) positions.push_back({all[i], all[i + 1], all[i + 2]});
        },
        [&] { return request.stopped(); });
    if (!complete) throw Stopped{};
    return positions;
}

struct Draped {
    double coefficient;  ///< %
    int folds;
};

Draped drape(const BenchRequest& request, const Fabric& fabric, std::uint32_t particles, double degrees,
             const Device& device) {
    const SceneDescription scene = drapemeter(fabric, particles, degrees);
    std::vector<std::uint32_t> corners;
    const std::vector<Vec3> positions =
        last_positions(request, scene, device, [&](const Simulation& started) { corners = started.triangles(0); });
    Shadow shadow;
    for (std::size_t k = 0; k + 2 < corners.size(); k += 3)
        shadow.add({positions[corners[k]], positions[corners[k + 1]], positions[corners[k + 2]]});
    const double disc = std::numbers::pi * disc_radius * disc_radius,
                 cell = std::pow(2 * cloth_radius / (particles - 1), 2);
    const double cloth = static_cast<double>(corners.size()) / 6 * cell;  // of six corners a cell
    return {100 * (shadow.area() - disc) / (cloth - disc), shadow.folds()};
}

/// The length of which B = weight c^3, m.
double bending_length(const Fabric& fabric, double rigidity) {
    return std::cbrt(rigidity / (fabric.areal_density * gravity));
}

/// Returns what Peirce's cantilever measures of a strip along the warp (axis 0) or the weft: it hangs over an edge by
/// twice its bending length, and the angle of the line to its end tells it.
double measured_bending_length(const BenchRequest& request, const Fabric& fabric, std::size_t axis,
                               const Device& device) {
    constexpr std::uint32_t links = 32;
    SceneDescription scene = at_rest(fabric, 3, 8);
    Cloth& cloth = scene.cloths[0];
    // Two held columns clamp the middle of their link.
    const double hanging = 2 * bending_length(fabric, cloth.stiffness.bend.along(axis)),
                 spacing = hanging / (links + 0.5);
    cloth.grid[axis] = links + 2, cloth.grid[1 - axis] = 3;
    cloth.size[axis] = (links + 1) * spacing, cloth.size[1 - axis] = 2 * spacing;
    const Vec3 out{1, 0, 0}, aside{0, 0, 1};
    cloth.placement = {times(-0.5 * spacing, out), axis == 0 ? out : aside, axis == 0 ? aside : out};
    IndexBox clamp{{0, 0}, {2, 2}};
    clamp.last[axis] = 1;
    cloth.pins = {held(clamp)};
    const Vec3 end = last_positions(request, scene, device).back();
    const double angle = std::atan2(-end[1], end[0]);
    return hanging * std::cbrt(std::cos(angle / 2) / (8 * std::tan(angle)));
}

/// Returns the modulus of a strip cut at 45 degrees, N/m, by the constants of the model (docs/physics.md 1).
double bias_modulus(const Stiffness& stiffness) {
    const double shear = stiffness.shear, warp = stiffness.stretch.warp + shear, weft = stiffness.stretch.weft + shear;
    return 4 / ((warp + weft - 2 * shear) / (warp * weft - shear * shear) + 1 / shear);
}

std::string drape_words(const Fabric& fabric) {
    for (const PublishedDrape& each : published_drapes)
        if (each.fabric == fabric.name) return fmt::format("{:g} to {:g}", each.least, each.most);
    return "-";
}

}  // namespace

BenchSummary run_fabric(const FabricRequest& request) {
    std::vector<Fabric> asked;
    for (const Fabric& fabric : fabrics)
        if (request.fabric.empty() || request.fabric == fabric.name) asked.push_back(fabric);
    if (asked.empty()) throw UsageError(fmt::format("--fabric '{}' is none of the fabrics", request.fabric));
    const std::vector<std::uint32_t> grids =
        request.grid == 0 ? std::vector<std::uint32_t>{65, 97} : std::vector<std::uint32_t>{request.grid};
    const Device device(request.device, validation_if(request.validate));
    CaseLoop loop(request, {}, 1);
    for (std::size_t k = 0; k < asked.size(); ++k) loop.plan(1);
    std::string text = "fabric    grid  turned  drape %  published  folds\n",
                lengths = "\nfabric    bending length, mm: warp  of   weft  of   bias stiffness, N/m\n";
    for (const Fabric& fabric : asked) {
        loop.begin(1);
        for (const std::uint32_t grid : grids)
            for (const double degrees : {0.0, 22.5, 45.0}) {
                const Draped draped = drape(request, fabric, grid, degrees, device);
                text += fmt::format("{:<9} {:>4} {:>7} {:>8.1f}  {:>9} {:>6}\n", fabric.name, grid, degrees,
                                    draped.coefficient, drape_words(fabric), draped.folds);
            }
        lengths += fmt::format("{:<9}", fabric.name);
        for (const std::size_t axis : {0u, 1u})
            lengths += fmt::format("{:>{}.1f} {:>5.1f}", 1e3 * measured_bending_length(request, fabric, axis, device),
                                   axis == 0 ? 26 : 7, 1e3 * bending_length(fabric, fabric.stiffness.bend.along(axis)));
        lengths += fmt::format("{:>10.1f}\n", bias_modulus(fabric.stiffness));
        loop.done(1, std::string(fabric.name));
    }
    BenchSummary summary = loop.summary();
    summary.text = report_head(device.info()).text() + "\n\n" + text + lengths;
    summary.validation_count = device.validation_count();
    return summary;
}

}  // namespace drape::bench
