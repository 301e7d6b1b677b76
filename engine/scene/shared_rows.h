// Values that keys of several objects of the scene format have. They are made before what uses them in a file.
#pragma once

#include "scene/scene_rules.h"

namespace drape::rows {

inline constexpr std::string_view key_time_help = "Seconds. Must be after the previous key's.",
                                  key_time_text = "a time in seconds";

inline const Named<Vec3> vec3{"vec3", "x, y, z; y is up, or z where the scene says so.", three_numbers(any_number)};
inline const Named<Vec3> direction{
    "direction", "x, y, z, not all zero; only the direction counts, the length does not.", unit_vector()};
inline const Named<Vec3> extents{"extents", "Metres along x, y, z.", three_numbers(positive)};
inline const Named<Vec3> color{"color", "red, green, blue.", three_numbers(unit_interval)};
inline const Object<MotionKey> motion_key{
    "motion_key",
    "One key of a path.",
    {
        {"t", &MotionKey::time, number(any_number), key_time_help, key_time_text},
        {"translate", &MotionKey::translate, vec3, "Metres, added to the rest pose."},
        {"rotate", &MotionKey::rotate, vec3, "Degrees: Euler angles about x, then y, then z (R = Rz Ry Rx)."},
    }};

inline const Named<MotionPath> path{
    "path",
    "A smooth way through the keys, component by component, angles too (so several turns are allowed), that never "
    "leaves "
    "the range of the two keys around it: cubic Hermite with slope (p[k+1] - p[k-1]) / (t[k+1] - t[k-1]) at inner "
    "keys, "
    "at most three times as steep as the straight lines to both neighbours and 0 where these go opposite ways or one "
    "is "
    "level, and 0 at the first and the last. Before the first and after the last key, that key holds. Times must "
    "increase strictly.",
    motion_path(motion_key)};

}  // namespace drape::rows
