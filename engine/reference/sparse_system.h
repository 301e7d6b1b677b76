// The linear systems of the implicit reference, the Hessian of the free particles plus a multiple of their masses, are
// factorised by sparse Cholesky. This header includes Eigen, so only .cpp files of this room include it.
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <cstdint>
#include <span>
#include <vector>

#include "reference/spring_network.h"

namespace drape {

class SparseSystem {
  public:
    /// The unknowns are the particles that are free at `time`, three each.
    SparseSystem(const SpringNetwork& network, double time);

    Eigen::Index unknown_count() const { return static_cast<Eigen::Index>(3 * free_.size()); }
    const std::vector<std::uint32_t>& free_particles() const { return free_; }

    /// Factorises hessian(position, form) + shift * mass, shift in 1/s^2; false when that is not positive definite.
    bool factorise(std::span<const Vec3> position, HessianForm form, double shift);
    Eigen::VectorXd solve(const Eigen::VectorXd& right) const { return cholesky_.solve(right); }

    /// Picks the free particles' entries out of `vectors`, and adds to them.
    Eigen::VectorXd gather(std::span<const Vec3> vectors) const;
    void add_to(std::vector<Vec3>& vectors, const Eigen::VectorXd& unknowns, double factor) const;

  private:
    const SpringNetwork& network_;
    std::vector<std::uint32_t> free_;
    std::vector<std::int64_t> first_unknown_;  ///< per particle, -1 when held
    Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> cholesky_;
    bool analysed_ = false;
};

/// Largest length of the three-vectors that `unknowns` consists of.
double largest_vector(const Eigen::VectorXd& unknowns);

}  // namespace drape
