// A triangle mesh whose vertices move through a series of poses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "mesh/mesh_shape.h"

namespace drape {

class MeshSequence {
  public:
    /// Takes the vertices' places in every pose, in m, pose by pose, in the order and the frame of those that `form`
    /// was made of; `places` are what its constructor gave. Throws MeshError where a pose parts vertices that lie in
    /// one place in the form, or turns a closed surface inside out.
    MeshSequence(const MeshShape& form, const std::vector<std::uint32_t>& places, const std::vector<float>& xyz);
    MeshSequence(const MeshSequence&) = delete;

    std::size_t count() const { return count_; }
    /// Returns the form moved to the middle of a box around all poses, which becomes its bounding box.
    const std::shared_ptr<const MeshShape>& form() const { return form_; }
    /// Returns the form that it has at a number of poses from the first one on, with the middle and the box of `form`.
    /// Between two poses the vertices move along straight lines; behind the last one, towards the first. The number is
    /// at least 0 and below `count`. The last ones that were asked for are kept.
    std::shared_ptr<const MeshShape> at(double pose) const;
    /// Returns a bound on how far a vertex moves in a straight line between two such numbers of poses, m.
    double farthest(double from, double to) const;
    /// Returns the most that the middle of two of a vertex's places is off a third one, m.
    double farthest_off_middle(double before, double between, double after) const;
    /// Returns x y z of the form's vertices, pose by pose, m.
    std::span<const float> places() const { return xyz_; }

  private:
    Vec3 place(std::size_t vertex, double pose) const;
    void expect_body(const MeshShape& form) const;

    std::size_t vertices_, count_ = 0;
    std::vector<float> xyz_;
    std::shared_ptr<const MeshShape> form_;
    mutable std::mutex mutex_;
    mutable std::deque<std::pair<double, std::shared_ptr<const MeshShape>>> recent_;
};

}  // namespace drape
