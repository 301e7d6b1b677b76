#include "world/motion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "world/key_value.h"

namespace drape {
namespace {

struct SineCosine {
    double sine;
    double cosine;
};

// The angle is reduced to [-45, 45] degrees before the conversion to radians, whose rounding would otherwise leave
// sin(360 degrees) at 1e-16 instead of 0.
SineCosine sine_cosine(double degrees) {
    const double turn = std::remainder(degrees, 360.0);
    const double quarter = std::nearbyint(turn / 90.0);
    const double radians = (turn - 90.0 * quarter) * (std::numbers::pi / 180.0);
    const double s = std::sin(radians);
    const double c = std::cos(radians);
    switch (static_cast<int>(quarter)) {
        case 0:
            return {s, c};
        case 1:
            return {c, -s};
        case -1:
            return {-c, s};
        default:
            return {-s, -c};
    }
}

template <class Key>
Vec3 slope_at(const std::vector<Key>& keys, std::size_t k, Vec3 Key::*member) {
    Vec3 slope{0, 0, 0};
    if (k == 0 || k + 1 == keys.size()) return slope;
    const double before = keys[k].time - keys[k - 1].time, after = keys[k + 1].time - keys[k].time;
    for (std::size_t i = 0; i < 3; ++i) {
        const double last = (keys[k - 1].*member)[i], here = (keys[k].*member)[i], next = (keys[k + 1].*member)[i];
        const double come = (here - last) / before, go = (next - here) / after;
        if (!(come > 0 && go > 0) && !(come < 0 && go < 0)) continue;
        // A cubic is monotone if neither of its slopes is above three times the mean one (Fritsch and Carlson 1980).
        const double most = 3 * std::min(std::abs(come), std::abs(go));
        slope[i] = std::clamp((next - last) / (before + after), -most, most);
    }
    return slope;
}

template <class Key>
Vec3 interpolate(const std::vector<Key>& keys, std::size_t k, double time, Vec3 Key::*member) {
    const double span = keys[k + 1].time - keys[k].time;
    const double s = (time - keys[k].time) / span;
    const Vec3& from = keys[k].*member;
    const Vec3& to = keys[k + 1].*member;
    const Vec3 slope_from = slope_at(keys, k, member);
    const Vec3 slope_to = slope_at(keys, k + 1, member);
    const double blend = s * s * (3 - 2 * s);
    const double from_weight = span * s * (1 - s) * (1 - s);
    const double to_weight = span * s * s * (s - 1);
    Vec3 result;
    for (std::size_t i = 0; i < 3; ++i)
        result[i] = from[i] + blend * (to[i] - from[i]) + from_weight * slope_from[i] + to_weight * slope_to[i];
    return result;
}

}  // namespace

std::array<double, 9> rotation_matrix(const Vec3& degrees) {
    if (degrees == Vec3{0, 0, 0}) return RigidTransform().rotation;
    const auto [sx, cx] = sine_cosine(degrees[0]);
    const auto [sy, cy] = sine_cosine(degrees[1]);
    const auto [sz, cz] = sine_cosine(degrees[2]);
    std::array<double, 9> matrix{cz * cy,
                                 cz * sy * sx - sz * cx,
                                 cz * sy * cx + sz * sx,  //
                                 sz * cy,
                                 sz * sy * sx + cz * cx,
                                 sz * sy * cx - cz * sx,  //
                                 -sy,
                                 cy * sx,
                                 cy * cx};
    for (double& entry : matrix) entry += 0.0;  // -0 becomes 0: the identity is the identity bit for bit
    return matrix;
}

template <class Key>
Vec3 keyed_value(const std::vector<Key>& keys, Vec3 Key::*value, double time) {
    if (keys.empty()) return {};
    const auto later =
        std::upper_bound(keys.begin(), keys.end(), time, [](double t, const Key& key) { return t < key.time; });
    if (later == keys.begin()) return keys.front().*value;
    const auto k = static_cast<std::size_t>(later - keys.begin()) - 1;
    if (later == keys.end() || time == keys[k].time) return keys[k].*value;
    return interpolate(keys, k, time, value);
}
template Vec3 keyed_value(const std::vector<CameraKey>&, Vec3 CameraKey::*, double);

MotionKey key_at(const MotionPath& path, double time) {
    return {time, keyed_value(path.keys, &MotionKey::translate, time),
            keyed_value(path.keys, &MotionKey::rotate, time)};
}

bool rests(const MotionPath& path, double from, double to) {
    const auto same = [](const MotionKey& a, const MotionKey& b) {
        return a.translate == b.translate && a.rotate == b.rotate;
    };
    // Between two keys nothing turns round, so what is equal at both ends is constant.
    const MotionKey first = key_at(path, from);
    return same(first, key_at(path, to)) && std::ranges::all_of(path.keys, [&](const MotionKey& key) {
               return key.time <= from || key.time >= to || same(key, first);
           });
}

RigidTransform motion_at(const MotionPath& path, double time) {
    if (path.keys.empty()) return {};
    const MotionKey key = key_at(path, time);
    return {rotation_matrix(key.rotate), key.translate};
}

}  // namespace drape
