#include "reference/sparse_system.h"

#include <algorithm>
#include <cmath>

namespace drape {

SparseSystem::SparseSystem(const SpringNetwork& network, double time)
    : network_(network), first_unknown_(network.particle_count(), -1) {
    for (std::uint32_t p = 0; p < network.particle_count(); ++p) {
        if (network.held(p, time)) continue;
        first_unknown_[p] = static_cast<std::int64_t>(3 * free_.size());
        free_.push_back(p);
    }
}

bool SparseSystem::factorise(std::span<const Vec3> position, HessianForm form, double shift) {
    std::vector<Eigen::Triplet<double>> triplets;
    for (const HessianEntry& entry : network_.hessian(position, form)) {
        const std::int64_t row = first_unknown_[entry.row / 3], column = first_unknown_[entry.column / 3];
        if (row < 0 || column < 0) continue;
        triplets.emplace_back(static_cast<int>(row + entry.row % 3), static_cast<int>(column + entry.column % 3),
                              entry.value);
    }
    for (std::size_t k = 0; k < free_.size(); ++k)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int place = static_cast<int>(3 * k + axis);
            triplets.emplace_back(place, place, shift * network_.mass[free_[k]]);
        }
    Eigen::SparseMatrix<double> matrix(unknown_count(), unknown_count());
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    // Zeros are stored too, so the pattern depends on the network alone.
    if (!analysed_) cholesky_.analyzePattern(matrix);
    analysed_ = true;
    cholesky_.factorize(matrix);
    return cholesky_.info() == Eigen::Success;
}

Eigen::VectorXd SparseSystem::gather(std::span<const Vec3> vectors) const {
    Eigen::VectorXd result(unknown_count());
    Eigen::Index place = 0;
    for (const std::uint32_t p : free_)
        for (const double component : vectors[p]) result[place++] = component;
    return result;
}

void SparseSystem::add_to(std::vector<Vec3>& vectors, const Eigen::VectorXd& unknowns, double factor) const {
    Eigen::Index place = 0;
    for (const std::uint32_t p : free_)
        for (double& component : vectors[p]) component += factor * unknowns[place++];
}

double largest_vector(const Eigen::VectorXd& unknowns) {
    double largest = 0;
    for (Eigen::Index k = 0; k + 2 < unknowns.size(); k += 3)
        largest = std::max(largest, unknowns.segment<3>(k).norm());
    return largest;
}

}  // namespace drape
