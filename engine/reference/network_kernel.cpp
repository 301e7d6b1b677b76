#include "reference/network_kernel.h"

#include <algorithm>
#include <cmath>

namespace drape {

namespace {

constexpr std::size_t block_size = 128;  // springs at a time: their forces stay in the first-level cache

}  // namespace

Planes to_planes(std::span<const Vec3> vectors) {
    Planes planes;
    for (std::size_t k = 0; k < 3; ++k) {
        planes[k].reserve(vectors.size());
        for (const Vec3& v : vectors) planes[k].push_back(v[k]);
    }
    return planes;
}

std::vector<Vec3> from_planes(const Planes& planes) {
    std::vector<Vec3> vectors(planes[0].size());
    for (std::size_t p = 0; p < vectors.size(); ++p) vectors[p] = {planes[0][p], planes[1][p], planes[2][p]};
    return vectors;
}

NetworkKernel::NetworkKernel(const SpringNetwork& network) : bending_(network.bending), gravity_(network.gravity) {
    for (const double m : network.mass) inverse_mass_.push_back(m > 0 ? 1 / m : 0.0);
    for (const NetworkSpring& spring : network.springs) {
        const bool continues = !runs_.empty() && spring.first == runs_.back().first + runs_.back().count &&
                               spring.second == runs_.back().second + runs_.back().count &&
                               runs_.back().count < block_size;
        if (!continues) runs_.push_back({spring.first, spring.second, 0, stiffness_.size()});
        ++runs_.back().count;
        stiffness_.push_back(spring.stiffness);
        stiffness_times_rest_.push_back(spring.stiffness * spring.rest_length);
        compression_.push_back(spring.compression);
    }
}

void NetworkKernel::add_run(const Run& run, const Planes& position, Planes& force) const {
    double fx[block_size], fy[block_size], fz[block_size];
    const double *ax = &position[0][run.first], *ay = &position[1][run.first], *az = &position[2][run.first];
    const double *bx = &position[0][run.second], *by = &position[1][run.second], *bz = &position[2][run.second];
    const double *k = &stiffness_[run.constant], *kl = &stiffness_times_rest_[run.constant];
    const double* pushed = &compression_[run.constant];
    for (std::size_t i = 0; i < run.count; ++i) {
        const double x = bx[i] - ax[i], y = by[i] - ay[i], z = bz[i] - az[i];
        // A spring without length has no direction; the bound makes its force 0 instead of NaN.
        const double size = std::max(std::sqrt(x * x + y * y + z * z), 1e-200);
        const double pull = k[i] - kl[i] / size;
        const double factor = pull * (pull < 0 ? pushed[i] : 1.0);
        fx[i] = factor * x;
        fy[i] = factor * y;
        fz[i] = factor * z;
    }
    // The two ends overlap, so they are added one after the other.
    const double* spring_force[3] = {fx, fy, fz};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        double* first = &force[axis][run.first];
        for (std::size_t i = 0; i < run.count; ++i) first[i] += spring_force[axis][i];
        double* second = &force[axis][run.second];
        for (std::size_t i = 0; i < run.count; ++i) second[i] -= spring_force[axis][i];
    }
}

void NetworkKernel::accelerations(const Planes& position, Planes& acceleration) const {
    for (std::size_t axis = 0; axis < 3; ++axis) acceleration[axis].assign(inverse_mass_.size(), 0.0);
    for (const Run& run : runs_) add_run(run, position, acceleration);
    for (const BendingElement& element : bending_)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            double difference = 0;
            for (std::size_t k = 0; k < 4; ++k)
                difference += element.coefficient[k] * position[axis][element.particle[k]];
            for (std::size_t k = 0; k < 4; ++k)
                acceleration[axis][element.particle[k]] -= element.stiffness * element.coefficient[k] * difference;
        }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        double* a = acceleration[axis].data();
        for (std::size_t p = 0; p < inverse_mass_.size(); ++p)
            a[p] = inverse_mass_[p] > 0 ? a[p] * inverse_mass_[p] + gravity_[axis] : 0.0;
    }
}

}  // namespace drape
