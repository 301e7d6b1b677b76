// The rows of the scene format that are about colliders.
#pragma once

#include "scene/shared_rows.h"

namespace drape::rows {

/// Returns the keys of a collider of one shape: the shape's own, then those that every collider has.
template <class Shape>
std::vector<Key<Collider>> keys_of(const std::vector<Key<Shape>>& own) {
    std::vector<Key<Collider>> keys;
    for (const Key<Shape>& key : own)
        keys.push_back(key.template within<Collider>(
            [](Collider& collider) -> Shape& { return std::get<Shape>(collider.shape); }));
    const Key<Collider> common[] = {
        {"friction", &Collider::friction, number(not_negative),
         "Coulomb coefficient of this side; a pair of surfaces uses the geometric mean."},
        {"rotate", &Collider::rotate, vec3,
         "Degrees, rest pose: Euler angles about x, then y, then z, about the collider's own centre (a plane's: normal "
         "* offset, a mesh's: the middle of its bounding box)."},
        {"path", &Collider::path, path,
         "Rigid motion on top of the rest pose, rotating about the collider's own centre (a plane's: normal * offset), "
         "which its translation takes along. Absent: at rest."},
        {"color", &Collider::color, color, "sRGB, for pictures only."},
    };
    keys.insert(keys.end(), std::begin(common), std::end(common));
    return keys;
}

/// Returns the keys of a collider of one shape that may be a body.
template <class Shape>
std::vector<Key<Collider>> body_keys_of(const std::vector<Key<Shape>>& own) {
    std::vector<Key<Collider>> keys = keys_of<Shape>(own);
    const Key<Collider> of_bodies[] = {
        {"mass", &Collider::mass, optional(number(positive)),
         "kg: gravity, cloth and other colliders move the collider, which has no path then. At least a tenth of what "
         "the heaviest cloth weighs that covers it. Not of a mesh that is a shell or deforms, nor of an ellipsoid "
         "beside a box, a mesh or another ellipsoid."},
        {"inertia", &Collider::inertia, optional(three_numbers(positive)),
         "kg m^2: its principal moments of inertia, about its centre of mass along its own axes (a capsule's y is its "
         "length, a mesh's are its file's). Absent: those of one density."},
        {"velocity", &Collider::velocity, vec3, "m/s, of a body at the start."},
        {"angular_velocity", &Collider::angular_velocity, vec3,
         "rad/s about the world's axes, of a body at the start."},
    };
    keys.insert(keys.end(), std::begin(of_bodies), std::end(of_bodies));
    return keys;
}

inline const Object<Collider> plane{
    "plane", "The cloth stays where normal . x >= offset, with the normal made unit length first.",
    keys_of<Plane>({
        {"normal", &Plane::normal, turned(direction),
         "Points to the outside. Where z is up, the default is [0, 0, 1]."},
        {"offset", &Plane::offset, number(any_number), "Metres from the origin along the unit normal."},
    })};
inline constexpr const char* body_schema = R"("not": {"required": ["mass", "path"]})";

inline const Object<Collider> sphere{"sphere", "A solid ball.",
                                     body_keys_of<Sphere>({
                                         {"center", &Sphere::center, vec3, "Metres."},
                                         {"radius", &Sphere::radius, number(positive), "Metres."},
                                     }),
                                     check_body, body_schema};
inline const Object<Collider> box{"box", "A solid box.",
                                  body_keys_of<Box>({
                                      {"center", &Box::center, vec3, "Metres."},
                                      {"half_extents", &Box::half_extents, extents, "Half the edge lengths, metres."},
                                  }),
                                  check_body, body_schema};
inline const Object<Collider> ellipsoid{"ellipsoid", "A solid ellipsoid.",
                                        body_keys_of<Ellipsoid>({
                                            {"center", &Ellipsoid::center, vec3, "Metres."},
                                            {"radii", &Ellipsoid::radii, extents, "Half axes, metres."},
                                        }),
                                        check_body, body_schema};

/// Reads one radius for both ends.
inline Value<std::array<double, 2>> equal_radii() {
    const Value<double> radius = number(positive);
    return {radius.text,
            [radius](const SceneNode& node, std::array<double, 2>& radii) {
                if (!node || !radius.read(node, radii[0])) return !node;
                radii[1] = radii[0];
                return true;
            },
            [radius](const std::array<double, 2>& radii) { return radius.write(radii[0]); }};
}

inline const Object<Collider> capsule{
    "capsule",
    "A sphere swept along a segment: a rod with round ends. With two radii it tapers; one end inside the other leaves "
    "the larger ball. Its centre is the segment's middle. At most one of radius and radii.",
    body_keys_of<Capsule>({
        {"from", &Capsule::from, vec3, "Metres: centre of one end."},
        {"to", &Capsule::to, vec3, "Metres: centre of the other end."},
        {"radius", &Capsule::radii, equal_radii(), "Metres."},
        {"radii", &Capsule::radii, without_default(two_numbers(positive)), "Metres, at from and at to."},
    }),
    check_capsule, R"("allOf": [{"not": {"required": ["radius", "radii"]}}, {"not": {"required": ["mass", "path"]}}])"};

inline const Object<Collider> mesh{
    "mesh",
    "A triangle mesh from a file, OBJ, PLY, STL or glTF 2 (uncompressed), of at most 4 million triangles and 256 "
    "MiB: the solid body that its surface bounds, parts that overlap being one, or a shell. At most one of shell "
    "and solid. Contact knows its distance at the points of a lattice and interpolates between them. Its centre is "
    "the middle of its bounding box.",
    body_keys_of<Mesh>({
        {"file", &Mesh::file, text(), "A relative name is looked for as a cloth's start is.", "the name of a file"},
        {"scale", &Mesh::scale, number(positive), "Metres per unit of the file."},
        {"position", &Mesh::position, vec3, "Metres: where the file's origin is."},
        {"shell", &Mesh::shell, optional(number(positive)),
         "Metres: thickness of a surface that is not closed, half of it on either side."},
        {"solid", &Mesh::solid, choice<Solid>(solid_spellings),
         "How the surface becomes a body's. mended: vertices at open edges that lie within 1e-6 of the bounding "
         "box's diagonal of each other are welded, triangles of a part turn the way that most of them do, parts "
         "turn outwards, those in a cavity inwards, and holes of at most 5 % of the surface's area are closed; a "
         "warning says what was done. Larger ones are refused, but gaps of up to 1 % of the diagonal between parts "
         "may stay: inside is what the surface winds around by more than a half. filled: likewise, and holes of any "
         "size are closed, of at most 10,000 edges. strict: a surface that is not closed is refused."},
        {"spacing", &Mesh::spacing, optional(number(positive)),
         "Metres between the points of the lattice. Absent: half of the least distance of particles, or of the shell's "
         "thickness, and more where that needs over 2 million points, or over 262144 of a mesh that deforms."},
        {"frames", &Mesh::frames, without_default(text()),
         "Where the vertices of file, an OBJ file, are in a series of poses: PC2, or NPY or NPZ (poses, vertices, 3), "
         "or "
         "OBJ files, with # in this name for the digits of their numbers. The mesh deforms, and its centre is the "
         "middle "
         "of the box about all poses."},
        {"frames_per_second", &Mesh::frames_per_second, number(positive),
         "Poses a second. Between two, vertices move along straight lines."},
        {"frames_start", &Mesh::frames_start, number(any_number),
         "Seconds: when the first pose is. It holds before, and the last one behind."},
        {"loop", &Mesh::loop, boolean(), "The first pose follows the last one, before the start too."},
    }),
    check_mesh, R"("allOf": [{"not": {"required": ["shell", "solid"]}}, {"not": {"required": ["mass", "path"]}}])"};

using Colliders = std::vector<Collider>;

/// Returns the key of one shape's list; all lists are read into the scene's one, in the order of their rows.
template <class Shape>
Key<Colliders> colliders_of(const Object<Collider>& object, std::string_view help) {
    const Value<Colliders> own =
        list<Collider>(object, "an array of at most 1024 colliders", 0, 1024, Collider{Shape{}});
    Key<Colliders> key(
        collider_lists[ColliderShape(Shape{}).index()], own.text,
        [own](const SceneNode& node, Colliders& all) {
            Colliders read;
            const bool fits = own.read(node, read);
            all.insert(all.end(), read.begin(), read.end());
            return fits;
        },
        help);
    key.text.default_value = own.write({});
    return key;
}

/// Returns one of the keys.
struct ListOf {
    Key<Colliders> operator()(const Plane&) const { return colliders_of<Plane>(plane, "Half-spaces."); }
    Key<Colliders> operator()(const Sphere&) const { return colliders_of<Sphere>(sphere, "Spheres."); }
    Key<Colliders> operator()(const Box&) const { return colliders_of<Box>(box, "Boxes."); }
    Key<Colliders> operator()(const Ellipsoid&) const { return colliders_of<Ellipsoid>(ellipsoid, "Ellipsoids."); }
    Key<Colliders> operator()(const Capsule&) const { return colliders_of<Capsule>(capsule, "Capsules."); }
    Key<Colliders> operator()(const Mesh&) const { return colliders_of<Mesh>(mesh, "Triangle meshes."); }
};
template <class... Shapes>
std::vector<Key<Colliders>> lists_of_all(const std::variant<Shapes...>&) {
    return {ListOf()(Shapes())...};
}

inline const Object<Colliders> colliders{"colliders", "Solid bodies the cloth stays outside of.",
                                         lists_of_all(ColliderShape())};

}  // namespace drape::rows
