// The few GLSL types and functions that headers shared by shaders and C++ use. In GLSL this file is empty.
//
// Shared headers are written in the common subset of both languages: float literals have an f, there are no swizzles
// and no inout, and only + - * / and sqrt where bits matter. Two words bridge the rest: `precise` (GLSL: never contract
// or reorder; C++: the whole project is compiled with -ffp-contract=off) and SHARED (C++: inline).
#ifndef DRAPE_GLSL_TYPES_H
#define DRAPE_GLSL_TYPES_H

#ifdef __cplusplus

#include <bit>
#include <cmath>
#include <cstdint>

#define SHARED inline
#define precise

namespace drape::glsl {

using uint = std::uint32_t;

struct vec2 {
    float x, y;
};
struct vec3 {
    float x, y, z;
};
struct alignas(16) vec4 {
    float x, y, z, w;
};
struct ivec2 {
    std::int32_t x, y;
    bool operator==(const ivec2&) const = default;
};
struct uvec2 {
    std::uint32_t x, y;
};
struct alignas(16) ivec4 {
    std::int32_t x, y, z, w;
};
struct alignas(16) uvec4 {
    std::uint32_t x, y, z, w;
};

inline vec3 operator+(vec3 a, vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline vec3 operator-(vec3 a, vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline vec3 operator-(vec3 a) { return {-a.x, -a.y, -a.z}; }
inline vec3 operator*(vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
inline vec3 operator*(float s, vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline vec3 operator*(vec3 a, vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline vec3 operator/(vec3 a, vec3 b) { return {a.x / b.x, a.y / b.y, a.z / b.z}; }
inline vec3 operator/(vec3 a, float s) { return {a.x / s, a.y / s, a.z / s}; }
inline float sqrt(float x) { return std::sqrt(x); }
inline float abs(float x) { return std::fabs(x); }
inline float floor(float x) { return std::floor(x); }
inline uint floatBitsToUint(float x) { return std::bit_cast<uint>(x); }
inline float uintBitsToFloat(uint x) { return std::bit_cast<float>(x); }

}  // namespace drape::glsl

#else

#define SHARED

#endif

#endif
