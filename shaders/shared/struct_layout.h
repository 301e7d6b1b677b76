// The layout of a struct that GLSL and C++ share (this folder), for C++ only. It is derived from the C++ type, so that
// nobody retypes its members: the number of initializers that the aggregate takes gives the number of members, a
// structured binding gives their places.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "shared/glsl_types.h"

namespace drape::glsl {

/// An element of a storage buffer or a block of push constants, in bytes.
struct StructLayout {
    std::string_view name;               ///< without its namespaces
    std::uint32_t size;                  ///< sizeof
    std::vector<std::uint32_t> offsets;  ///< one per member, in order; none for a scalar or vector
};

namespace detail {

/// Converts to the type of any member.
template <std::size_t>
struct Anything {
    template <class T>
    operator T() const;
};

template <class T, class... Values>
constexpr std::size_t initializer_count() {
    if constexpr (requires { T{Values{}..., Anything<0>{}}; })
        return initializer_count<T, Values..., Anything<0>>();
    else
        return sizeof...(Values);
}

/// Whether T takes one initializer in braces between those before and after it.
template <class T, std::size_t... Before, std::size_t... After>
constexpr bool takes(std::index_sequence<Before...>, std::index_sequence<After...>) {
    return requires { T{Anything<Before>{}..., {Anything<0>{}}, Anything<After>{}...}; };
}

/// Initializers for the member that begins with initializer `First` of `All`: an array's elements, else 1.
template <class T, std::size_t First, std::size_t All, std::size_t Length = 1>
constexpr std::size_t member_length() {
    if constexpr (takes<T>(std::make_index_sequence<First>{}, std::make_index_sequence<All - First - Length>{}))
        return Length;
    else
        return member_length<T, First, All, Length + 1>();
}

template <class T, std::size_t First = 0, std::size_t All = initializer_count<T>()>
constexpr std::size_t member_count() {
    if constexpr (First == All)
        return 0;
    else
        return 1 + member_count<T, First + member_length<T, First, All>(), All>();
}

template <class T, class... Members>
std::vector<std::uint32_t> offsets_in(const T& whole, const Members&... members) {
    const auto address = [](const auto& value) { return reinterpret_cast<const std::byte*>(&value); };
    return {static_cast<std::uint32_t>(address(members) - address(whole))...};
}

template <class T>
std::vector<std::uint32_t> member_offsets() {
    constexpr std::size_t count = member_count<T>();
    static_assert(count >= 1 && count <= 22, "a struct shared with GLSL has 1 to 22 members");
    const T v{};
#define DRAPE_MEMBERS(number, ...)         \
    if constexpr (count == number) {       \
        const auto& [__VA_ARGS__] = v;     \
        return offsets_in(v, __VA_ARGS__); \
    }
    DRAPE_MEMBERS(1, a)
    DRAPE_MEMBERS(2, a, b)
    DRAPE_MEMBERS(3, a, b, c)
    DRAPE_MEMBERS(4, a, b, c, d)
    DRAPE_MEMBERS(5, a, b, c, d, e)
    DRAPE_MEMBERS(6, a, b, c, d, e, f)
    DRAPE_MEMBERS(7, a, b, c, d, e, f, g)
    DRAPE_MEMBERS(8, a, b, c, d, e, f, g, h)
    DRAPE_MEMBERS(9, a, b, c, d, e, f, g, h, i)
    DRAPE_MEMBERS(10, a, b, c, d, e, f, g, h, i, j)
    DRAPE_MEMBERS(11, a, b, c, d, e, f, g, h, i, j, k)
    DRAPE_MEMBERS(12, a, b, c, d, e, f, g, h, i, j, k, l)
    DRAPE_MEMBERS(13, a, b, c, d, e, f, g, h, i, j, k, l, m)
    DRAPE_MEMBERS(14, a, b, c, d, e, f, g, h, i, j, k, l, m, n)
    DRAPE_MEMBERS(15, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o)
    DRAPE_MEMBERS(16, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p)
    DRAPE_MEMBERS(17, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q)
    DRAPE_MEMBERS(18, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r)
    DRAPE_MEMBERS(19, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s)
    DRAPE_MEMBERS(20, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t)
    DRAPE_MEMBERS(21, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u)
    DRAPE_MEMBERS(22, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, w)
#undef DRAPE_MEMBERS
}

template <class T, class... Others>
constexpr bool is_one_of = (std::is_same_v<T, Others> || ...);

/// Returns "Collider" for drape::glsl::Collider.
template <class T>
constexpr std::string_view type_name() {
    std::string_view name = __PRETTY_FUNCTION__;  // "... [with T = drape::glsl::Collider; ...]"
    name.remove_prefix(name.find("T = ") + 4);
    name = name.substr(0, name.find_first_of(";]"));
    return name.substr(name.rfind(':') + 1);
}

}  // namespace detail

template <class T>
const StructLayout& layout_of() {
    constexpr bool plain = std::is_arithmetic_v<T> || detail::is_one_of<T, vec2, vec3, vec4, ivec2, ivec4, uvec4>;
    static const StructLayout layout = [] {
        if constexpr (plain)
            return StructLayout{detail::type_name<T>(), sizeof(T), {}};
        else
            return StructLayout{detail::type_name<T>(), sizeof(T), detail::member_offsets<T>()};
    }();
    return layout;
}

}  // namespace drape::glsl
