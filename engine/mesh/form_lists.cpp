#include "mesh/form_lists.h"

#include <algorithm>
#include <cmath>

namespace drape {

namespace {

/// Calls `see` with the middle of every block of samples.
template <class See>
void for_each_block(const DistanceField& field, const See& see) {
    constexpr std::uint32_t block = glsl::guess_block;
    const auto middle = [&](std::size_t axis, std::uint32_t k) {
        return field.lower[axis] + field.spacing * (k + 0.5 * (block - 1));
    };
    for (std::uint32_t z = 0; z < field.size[2]; z += block)
        for (std::uint32_t y = 0; y < field.size[1]; y += block)
            for (std::uint32_t x = 0; x < field.size[0]; x += block)
                see(Vec3{middle(0, x), middle(1, y), middle(2, z)});
}

template <class T>
void add(std::vector<T>& to, const std::vector<T>& more) {
    to.insert(to.end(), more.begin(), more.end());
}

}  // namespace

void FormLists::append(const FormLists& other) {
    add(nodes, other.nodes);
    add(corners, other.corners);
    add(guesses, other.guesses);
    add(sides, other.sides);
}

FormLists form_lists(const MeshShape& form, const DistanceField& field, double exact) {
    FormLists lists;
    form.tree().append_to(lists.nodes);
    for (const Triangle& triangle : form.triangles())
        for (const std::uint32_t corner : triangle) {
            const Vec3& at = form.vertices()[corner];
            lists.corners.push_back(
                {static_cast<float>(at[0]), static_cast<float>(at[1]), static_cast<float>(at[2]), 0});
        }
    std::uint32_t nearest = 0;
    const double half_diagonal = 0.5 * (glsl::guess_block - 1) * std::sqrt(3.0) * field.spacing;
    for_each_block(field, [&](const Vec3& middle) {
        // The tree may tell it 2 % too far, and a sample be nearer by half the block's diagonal.
        const double least = form.tree().distance(middle, 0, nearest) / 1.02 - half_diagonal - 0.5 * form.shell();
        lists.guesses.push_back(least > exact ? nearest | glsl::guess_does : nearest);
    });
    const std::size_t columns = field.size[0], rows = std::size_t{field.size[1]} * field.size[2];
    lists.sides.resize((columns * rows + 31) / 32);
    for (std::size_t row = 0; row < rows; ++row) {
        const std::size_t line = row % field.size[1], layer = row / field.size[1];
        const auto y = static_cast<double>(line), z = static_cast<double>(layer);
        const std::vector<bool> inside =
            form.inside({field.lower[0], field.lower[1] + y * field.spacing, field.lower[2] + z * field.spacing},
                        field.spacing, columns);
        for (std::size_t x = 0; x < columns; ++x)
            if (inside[x]) lists.sides[(row * columns + x) / 32] |= 1u << ((row * columns + x) % 32);
    }
    return lists;
}

}  // namespace drape
