// A fabric gives a cloth's density, stiffness, friction and looks a name. A scene names one ("fabric": "cotton"), and
// its own keys override single values.
#pragma once

#include <string_view>

#include "drape/scene.h"

namespace drape {

struct Fabric {
    std::string_view name;
    double areal_density;  ///< kg/m^2
    Stiffness stiffness;
    double friction;          ///< Coulomb coefficient of the cloth's side
    double roughness, sheen;  ///< how it looks (Appearance), estimated
    std::string_view source;  ///< says where the numbers come from, and which are estimated
};

// engine/docs/fabrics.md has the measurements, their tables and units, and what was made of them. One momme is 4.34
// g/m^2.
inline constexpr Fabric fabrics[] = {
    {"cotton",
     0.22,
     {false, {4040, 4003}, 30, {31.4e-6, 31.4e-6, 22.6e-6}},
     0.5,
     0.9,
     0.3,
     "Trousers of 65 % cotton, measured by Wang et al. 2011 (royal-target); friction estimated."},
    {"silk",
     0.069,
     {false, 2000, 20, 4e-6},
     0.25,
     0.35,
     0.15,
     "Habutai of 16 momme, which is its density; the rest estimated."},
    {"denim",
     0.324,
     {false, {1993, 376}, 35, {16.0e-6, 24.2e-6, 16.6e-6}},
     0.6,
     0.95,
     0.2,
     "Jeans of 99 % cotton, 11 oz, measured by Wang et al. 2011 (11oz-black-denim); friction estimated."},
    {"wool",
     0.264,
     {false, 4900, 48, 13.3e-6},
     0.5,
     0.9,
     0.5,
     "Worsted suiting for winter, the mean of 214 measured by Kawabata 1980; friction estimated."},
    {"jersey",
     0.187,
     {false, {51, 15}, 18, {5.8e-6, 3.6e-6, 7.7e-6}},
     0.5,
     0.9,
     0.4,
     "Interlock knit of 60 % cotton, wales along the warp, measured by Wang et al. 2011 (gray-interlock); friction "
     "estimated."},
    {"canvas",
     0.34,
     {false, 5000, 150, 2e-4},
     0.6,
     0.95,
     0.2,
     "Cotton duck of 10 oz, which is its density; the rest estimated."},
    {"leather",
     0.56,
     {false, 6000, 3000, 3e-5},
     0.6,
     0.45,
     0.05,
     "Sheep garment leather 0.8 mm thick: bend by the drape that Memon et al. 2021 measured; the rest estimated, as a "
     "homogeneous sheet of 10 MPa and 700 kg/m^3."},
};

/// Returns null when no fabric has that name.
constexpr const Fabric* find_fabric(std::string_view name) {
    for (const Fabric& fabric : fabrics)
        if (fabric.name == name) return &fabric;
    return nullptr;
}

inline void set_fabric(Cloth& cloth, const Fabric& fabric) {
    cloth.areal_density = fabric.areal_density;
    cloth.stiffness = fabric.stiffness;
    cloth.friction = fabric.friction;
    cloth.appearance.roughness = fabric.roughness;
    cloth.appearance.sheen = fabric.sheen;
}

}  // namespace drape
