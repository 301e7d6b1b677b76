// Rows of the scene format: gas that cloths close in.
#pragma once

#include "scene/scene_rules.h"
#include "scene/shared_rows.h"

namespace drape::rows {

inline const Object<NumberKey> gas_key{
    "gas_key",
    "One key of an amount of gas that changes.",
    {
        {"t", &NumberKey::time, number(any_number), key_time_help, key_time_text},
        {"volume", &NumberKey::value, number(not_negative), "m^3, at ambient pressure.", "a volume of 0 or more"},
    }};

inline const Object<Gas> gas{
    "gas",
    "An ideal gas at constant temperature, closed in by cloths that are sewn to a closed surface: (p + ambient) V = "
    "ambient Vn, V being what they close in and p the pressure above ambient, which presses on them outwards. A "
    "cushion is blown up by a Vn that grows. Nothing may open the surface: no cutters, no tear, no seam with rip or "
    "close. Cloths of two gases are not sewn together. Of a seam with unlike numbers of particles each of the coarser"
    " side is at one of the finer side. Exactly one of volume and volume_keys says how much there is.",
    {
        {"cloths", &Gas::cloths,
         without_default(list<std::string>(text(), "an array of 1 to 1024 names of cloths", 1, 1024)),
         "Names of all cloths that close it in.", "the names of the cloths that close it in"},
        {"volume", &Gas::volume, optional(number(not_negative)), "m^3: Vn, its volume at ambient pressure."},
        {"volume_keys", &Gas::volume_keys, keys_in_time<NumberKey>(gas_key),
         "A volume at ambient pressure that changes; between, before and after its keys as a wind does. A substep has "
         "it at its middle."},
        {"ambient", &Gas::ambient, number(positive), "Pa: the absolute pressure outside."},
        {"outside", &Gas::outside, optional(choice<ClothSide>(cloth_side_spellings)),
         "Which side of the first cloth is outside: its front, the side of u x v, or its back. Those of the others "
         "follow from the seams. Absent: the side by which they close in a volume above 0 at the start, which cloths "
         "that start flat do not."},
    },
    nullptr,
    R"("oneOf": [{"required": ["volume"]}, {"required": ["volume_keys"]}])"};

}  // namespace drape::rows
