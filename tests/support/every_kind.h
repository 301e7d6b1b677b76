// Colliders for tests that look at every kind.
#pragma once

#include <type_traits>
#include <variant>
#include <vector>

#include "drape/scene.h"

namespace drape::test {

template <class Shape, class... Others>
inline constexpr bool is_among = (std::is_same_v<Shape, Others> || ...);

template <class... Kinds, class... Given>
consteval bool cover(const std::variant<Kinds...>*, const Given*...) {
    return (is_among<Kinds, Given...> && ...);
}

/// Returns the shapes. It does not compile unless every kind is among them, but for those that the caller leaves out.
template <class... LeftOut, class... Shapes>
std::vector<ColliderShape> of_every_kind(const Shapes&... shapes) {
    static_assert(cover(static_cast<const ColliderShape*>(nullptr), static_cast<const LeftOut*>(nullptr)...,
                        static_cast<const Shapes*>(nullptr)...),
                  "a kind of collider is missing");
    return {shapes...};
}

/// Returns a collider of each of the shapes, at rest.
inline std::vector<Collider> colliders_of(const std::vector<ColliderShape>& shapes) {
    std::vector<Collider> all;
    for (const ColliderShape& shape : shapes) all.push_back({shape});
    return all;
}

}  // namespace drape::test
