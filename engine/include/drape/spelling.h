// The words of a scene file that stand for values of an enumeration.
#pragma once

#include <cstddef>
#include <string_view>

namespace drape {

/// A value of an enumeration and its word in the scene file.
template <class T>
struct Spelling {
    std::string_view name;
    T value;
};

template <class T, std::size_t count>
constexpr std::string_view spelling(const Spelling<T> (&spellings)[count], T value) {
    for (const Spelling<T>& candidate : spellings)
        if (candidate.value == value) return candidate.name;
    return {};
}

}  // namespace drape
