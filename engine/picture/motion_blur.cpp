#include "picture/motion_blur.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

namespace drape {
namespace {

// 256 pictures of 255 times this fit into 32 bits.
constexpr std::uint32_t white_light = 65535;

double linear_light(double srgb) { return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4); }
double shown_light(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// The tables give linear light by level, and the level by linear light.
struct Levels {
    Levels() : level(white_light + 1) {
        for (std::size_t i = 0; i < light.size(); ++i)
            light[i] =
                static_cast<std::uint32_t>(std::lround(white_light * linear_light(static_cast<double>(i) / 255)));
        for (std::size_t i = 0; i < level.size(); ++i)
            level[i] = static_cast<std::uint8_t>(std::lround(255 * shown_light(static_cast<double>(i) / white_light)));
    }
    std::array<std::uint32_t, 256> light{};
    std::vector<std::uint8_t> level;
};

const Levels& levels() {
    static const Levels all;
    return all;
}

}  // namespace

void PictureMean::clear() {
    sums_.clear();
    count_ = 0;
}

void PictureMean::add(std::span<const std::uint8_t> rgba) {
    sums_.resize(rgba.size(), 0);
    const auto& light = levels().light;
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
        const std::uint32_t alpha = rgba[i + 3];
        for (std::size_t k = 0; k < 3; ++k) sums_[i + k] += light[rgba[i + k]] * alpha;
        sums_[i + 3] += alpha;
    }
    ++count_;
}

std::span<const std::uint8_t> PictureMean::mean() {
    rgba_.assign(sums_.size(), 0);
    const std::vector<std::uint8_t>& level = levels().level;
    for (std::size_t i = 0; i < sums_.size(); i += 4) {
        const std::uint32_t covered = sums_[i + 3];
        if (covered == 0) continue;
        for (std::size_t k = 0; k < 3; ++k) rgba_[i + k] = level[(sums_[i + k] + covered / 2) / covered];
        rgba_[i + 3] = static_cast<std::uint8_t>((covered + count_ / 2) / count_);
    }
    return rgba_;
}

std::vector<float> positions_before(std::span<const float> positions, std::span<const float> velocities, double ago) {
    std::vector<float> before(positions.begin(), positions.end());
    const auto time = static_cast<float>(ago);
    for (std::size_t i = 0; i < before.size(); ++i)
        if (i % 4 != 3) before[i] -= time * velocities[i];  // w is no coordinate
    return before;
}

std::vector<BodyState> bodies_before(const std::vector<BodyState>& bodies, double ago) {
    std::vector<BodyState> before = bodies;
    for (BodyState& body : before) {
        const Eigen::Map<const Eigen::Vector3d> spin(body.angular_velocity.data());
        Eigen::Map<Eigen::Vector3d>(body.position.data()) -= ago * Eigen::Map<Eigen::Vector3d>(body.velocity.data());
        const double rate = spin.norm();
        if (!(rate > 0)) continue;
        Eigen::Map<Eigen::Quaterniond> turn(body.turn.data());
        turn = Eigen::Quaterniond(Eigen::AngleAxisd(-ago * rate, spin / rate)) * turn;
    }
    return before;
}

}  // namespace drape
