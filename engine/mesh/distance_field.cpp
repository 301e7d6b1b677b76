#include "mesh/distance_field.h"

#include <atomic>
#include <cmath>
#include <map>
#include <mutex>
#include <thread>
#include <tuple>

namespace drape {

namespace {

/// Cells around the body and its margin, for slopes.
constexpr double further_cells = 2;
std::array<std::uint32_t, 3> size_of(const MeshShape& shape, double spacing, double margin) {
    std::array<std::uint32_t, 3> size{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        size[axis] = static_cast<std::uint32_t>(
                         std::ceil(2 * (shape.half_extents()[axis] + margin) / spacing + 2 * further_cells)) +
                     1;
    return size;
}

DistanceField made(const MeshShape& shape, double spacing, double margin) {
    DistanceField field = empty_field(shape, spacing, margin);
    const std::size_t columns = field.size[0], rows = field.size[1], layers = field.size[2];
    field.samples.resize(columns * rows * layers);
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        std::vector<double> row(columns);
        for (std::size_t z = next++; z < layers; z = next++)
            for (std::size_t y = 0; y < rows; ++y) {
                shape.distances({field.lower[0], field.lower[1] + static_cast<double>(y) * spacing,
                                 field.lower[2] + static_cast<double>(z) * spacing},
                                spacing, exact_within(spacing, margin), row);
                float* const samples = field.samples.data() + (z * rows + y) * columns;
                for (std::size_t x = 0; x < columns; ++x) samples[x] = static_cast<float>(row[x]);
            }
    };
    std::vector<std::jthread> threads;
    for (unsigned k = 1; k < std::thread::hardware_concurrency(); ++k) threads.emplace_back(work);
    work();
    threads.clear();
    return field;
}

}  // namespace

double exact_within(double spacing, double margin) { return margin + further_cells * spacing; }

DistanceField empty_field(const MeshShape& shape, double spacing, double margin) {
    DistanceField field{{}, spacing, size_of(shape, spacing, margin), {}};
    for (std::size_t axis = 0; axis < 3; ++axis) field.lower[axis] = -0.5 * spacing * (field.size[axis] - 1);
    return field;
}

std::size_t field_points(const MeshShape& shape, double spacing, double margin) {
    double points = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
        points *= std::ceil(2 * (shape.half_extents()[axis] + margin) / spacing + 2 * further_cells) + 1;
    return points < 1e18 ? static_cast<std::size_t>(points) : std::size_t{1} << 60;
}

double field_spacing(const MeshShape& shape, double wanted, double margin, std::size_t most) {
    double spacing = wanted;
    while (field_points(shape, spacing, margin) > most) spacing *= 1.02;
    return spacing;
}

std::shared_ptr<const DistanceField> distance_field(const std::shared_ptr<const MeshShape>& shape, double spacing,
                                                    double margin) {
    static std::mutex mutex;
    static std::map<std::tuple<const MeshShape*, double, double>, std::weak_ptr<const DistanceField>> kept;
    const std::lock_guard lock(mutex);
    std::erase_if(kept, [](const auto& each) { return each.second.expired(); });
    std::weak_ptr<const DistanceField>& known = kept[{shape.get(), spacing, margin}];
    std::shared_ptr<const DistanceField> field = known.lock();
    if (!field) {
        // The field keeps its shape alive, so that no other shape can get the same address.
        struct Kept {
            std::shared_ptr<const MeshShape> shape;
            DistanceField field;
        };
        auto both = std::make_shared<Kept>(Kept{shape, made(*shape, spacing, margin)});
        known = field = std::shared_ptr<const DistanceField>(both, &both->field);
    }
    return field;
}

}  // namespace drape
