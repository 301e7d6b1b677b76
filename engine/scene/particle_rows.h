// The rows of what holds a cloth's particles or pulls at them.
#pragma once

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "scene/shared_rows.h"

namespace drape::rows {

/// Reads a text that a rule takes up, or nobody.
template <class Object>
bool read_text(const SceneNode& node, Object&) {
    std::string ignored;
    return node.read(ignored);
}

/// Reads a point; the rule of the cloth, which knows the outline, finds its particle.
template <class Object>
bool read_point(const SceneNode& node, Object&) {
    std::array<double, 2> ignored{};
    return two_numbers(any_number).read(node, ignored);
}

inline const Named<IndexBox> one_particle{"particle", "[column, row], from 0, within the grid.", particle()};
inline const Named<IndexBox> particles{
    "particle_box", "First and last particle, inclusive; the first may not be beyond the last in column or row.",
    particle_box(one_particle)};

/// Returns the keys that say which particles, and then the others.
template <class T>
std::vector<Key<T>> particles_and(std::vector<Key<T>> others) {
    std::vector<Key<T>> keys{
        {"edge", &T::particles, without_default(choice<IndexBox>(edge_spellings)),
         "All particles of a border: left is column 0, top is row 0."},
        {"corner", &T::particles, without_default(choice<IndexBox>(corner_spellings)),
         "One corner particle: left is column 0, top is row 0."},
        {"at", &T::particles, one_particle, "One particle."},
        {"box", &T::particles, particles, "All particles of a box."},
        {"point", two_numbers(any_number).text, read_point<T>,
         "The particle that is nearest to a point [x, y] of the cloth's outline, metres."},
    };
    std::ranges::move(others, std::back_inserter(keys));
    return keys;
}

inline const Object<Pin> pin{
    "pin",
    "Holds particles where they start or moves them along a path. Exactly one of edge, corner, at, box and point says "
    "which.",
    particles_and<Pin>({
        {"release", &Pin::release, optional(number(not_negative)),
         "Seconds. From then on the particles are free and keep their velocity. Absent: never."},
        {"path", &Pin::path, path, "Rigid motion of the particles relative to where they start. Absent: at rest."},
        {"pivot", &Pin::pivot, optional<Vec3>(vec3),
         "Metres: the point the path rotates about, which its translation takes along. Absent: the centroid of the "
         "particles where they start, without those that a later pin holds."},
    }),
    check_pin,
    R"("oneOf": [{"required": ["edge"]}, {"required": ["corner"]}, {"required": ["at"]}, {"required": ["box"]}, {"required": ["point"]}])"};

inline const Object<VectorKey> force_key{"force_key",
                                         "One key of a force that changes.",
                                         {
                                             {"t", &VectorKey::time, number(any_number), key_time_help, key_time_text},
                                             {"force", &VectorKey::value, vec3, "N.", "a force of 3 numbers"},
                                         }};

inline const Object<NumberKey> pressure_key{
    "pressure_key",
    "One key of a pressure that changes.",
    {
        {"t", &NumberKey::time, number(any_number), key_time_help, key_time_text},
        {"pressure", &NumberKey::value, number(any_number), "Pa.", "a pressure"},
    }};

inline const Object<Load> load{
    "load",
    "Pulls at particles or presses on a side of the cloth. At most one of edge, corner, at, box and point says which "
    "particles; without any it is all. Exactly one of force, force_keys, pressure and pressure_keys says how much. "
    "What "
    "acts on held particles, their pins bear.",
    particles_and<Load>({
        {"force", &Load::force, without_default<Vec3>(vec3),
         "N, in the world's axes, on all of its particles together. They share it by their areas, a quarter of each "
         "cell that a particle has: along an edge its corners have half as much as the others. After a cut each keeps "
         "its share."},
        {"force_keys", &Load::force_keys, keys_in_time<VectorKey>(force_key),
         "A force that changes; between, before and after its keys as a wind does. A substep has it at its middle."},
        {"pressure", &Load::pressure, optional(number(any_number)),
         "Pa: on each quarter of a cell that is a particle's, this times its area as it is now, square to it; above 0 "
         "towards the front, the side of u x v, below 0 towards the back."},
        {"pressure_keys", &Load::pressure_keys, keys_in_time<NumberKey>(pressure_key),
         "A pressure that changes, likewise."},
        {"map", text().text, read_text<Load>,
         "File of a picture (see maps) that spans the cloth, or has a pixel for each particle: factors from 0 to 1. "
         "The "
         "force is shared by area times factor, and is as large as without; the pressure of a particle is factor times "
         "pressure. Absent: 1."},
    }),
    check_load,
    R"("oneOf": [{"required": ["force"]}, {"required": ["force_keys"]}, {"required": ["pressure"]}, {"required": ["pressure_keys"]}])"};

}  // namespace drape::rows
