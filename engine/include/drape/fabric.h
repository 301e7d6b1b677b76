// A fabric gives a cloth's density, stiffness and friction a name. A scene names one ("fabric": "cotton"), and its own
// keys override single values.
#pragma once

#include <string_view>

#include "drape/scene.h"

namespace drape {

struct Fabric {
    std::string_view name;
    double areal_density;  ///< kg/m^2
    Stiffness stiffness;
    double friction;          ///< Coulomb coefficient of the cloth's side
    std::string_view source;  ///< says where the numbers come from, and which are estimated
};

// The measured values are the first measuring points of the material files published with H. Wang, J. F. O'Brien, R.
// Ramamoorthi, "Data-driven elastic models for cloth: modeling and measurement", ACM Transactions on Graphics 30(4):71,
// 2011. One momme is 4.34 g/m^2. A homogeneous sheet bends with E t^3 / 12 and stretches with E t.
inline constexpr Fabric fabrics[] = {
    {"cotton",
     0.22,
     {false, 4070, 60, 1.25e-4},
     0.5,
     "Woven trouser cloth (65 % cotton): density, stretch and bend as measured by Wang et al. 2011 (royal-target); "
     "shear and friction estimated."},
    {"silk",
     0.069,
     {false, 2000, 20, 4e-6},
     0.25,
     "Habutai of 16 momme, which is its density; stretch, shear, bend and friction estimated."},
    {"denim",
     0.324,
     {false, 2030, 120, 6.4e-5},
     0.6,
     "11 oz: density, stretch and bend as measured by Wang et al. 2011 (11oz-black-denim); shear in the range of 84 to "
     "191 N/m that Journal of Textiles 2016, 4614168, measured (KES, table 5); friction estimated."},
    {"leather",
     0.56,
     {false, 8000, 3000, 4.3e-4},
     0.6,
     "Sheep garment leather 0.8 mm thick (Memon et al., Materials 14(16):4553, 2021: 0.64 to 0.96 mm); the rest "
     "estimated, as a homogeneous sheet of 10 MPa and 700 kg/m^3."},
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
}

}  // namespace drape
