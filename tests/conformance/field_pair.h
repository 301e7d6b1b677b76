// A field as a step of the device and the same step of the twin left it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cloth/texels.h"

namespace drape::test {

/// Either numbers or integers are set, equally many on both sides.
struct FieldPair {
    std::string name;
    std::vector<float> device{}, twin{};
    std::vector<std::uint32_t> device_integers{}, twin_integers{};
    /// The magnitude that roundings are counted at, where no number of the field is larger: that of what the step
    /// computed it from, as an edge for a displacement.
    double least_scale = 0;
};

/// Collects the texels of a field: x, y, z share a scale, so they are one pair, and w is another.
class TexelPairs {
  public:
    explicit TexelPairs(const std::string& name, double least_scale = 0, double least_scale_of_w = 0)
        : xyz_{.name = name, .least_scale = least_scale}, w_{.name = name + ".w", .least_scale = least_scale_of_w} {}
    void add(const glsl::vec4& device, const glsl::vec4& twin) {
        add(xyz(device), xyz(twin));
        w_.device.push_back(device.w);
        w_.twin.push_back(twin.w);
    }
    void add(const glsl::vec3& device, const glsl::vec3& twin) {
        xyz_.device.insert(xyz_.device.end(), {device.x, device.y, device.z});
        xyz_.twin.insert(xyz_.twin.end(), {twin.x, twin.y, twin.z});
    }
    void put_into(std::vector<FieldPair>& pairs) const {
        pairs.push_back(xyz_);
        if (!w_.device.empty()) pairs.push_back(w_);
    }

  private:
    FieldPair xyz_, w_;
};

/// Collects numbers that each follow from a decision, which rounding may turn. A number is compared where device and
/// twin decided alike.
class DecidedPairs {
  public:
    explicit DecidedPairs(const std::string& name, double least_scale = 0)
        : decisions_{.name = name + ", decided"}, numbers_{.name = name, .least_scale = least_scale} {}
    /// `ours`: what the device decided; nothing where its number comes of no decision, so that it counts as a number.
    void add(std::optional<std::uint32_t> ours, std::uint32_t theirs, float device, float twin) {
        decisions_.device_integers.push_back(ours.value_or(theirs));
        decisions_.twin_integers.push_back(theirs);
        if (ours.value_or(theirs) != theirs) return;
        numbers_.device.push_back(device);
        numbers_.twin.push_back(twin);
    }
    void put_into(std::vector<FieldPair>& pairs) const {
        pairs.push_back(decisions_);
        pairs.push_back(numbers_);
    }

  private:
    FieldPair decisions_, numbers_;
};

}  // namespace drape::test
