// Exported runs say which collider a particle touches.
#include "run/contacts.h"

#include <gtest/gtest.h>

#include "support/sheets.h"

namespace drape {
namespace {

/// Particles at 1 to 5 cm above a plane, which a map makes so thick, or half as thick.
TEST(Contacts, AParticleTouchesAtTheThicknessThatItsMapGives) {
    SceneDescription scene = test::sheet(5, 2, 1, 1, 4);
    scene.colliders = {{Plane{}}};
    Cloth& cloth = scene.cloths[0];
    cloth.thickness = 0.05;
    std::vector<float> places;
    for (const float thin : {1.0f, 0.5f})
        for (int k = 1; k <= 5; ++k) {
            cloth.particle_thickness.push_back(thin * 0.2f * static_cast<float>(k));
            places.insert(places.end(), {0, 0.01f * static_cast<float>(k), 0, 1});
        }
    EXPECT_EQ(touched_colliders(scene.cloths[0], scene.colliders, 0, places),
              (std::vector<std::int16_t>{0, 0, 0, 0, 0, -1, -1, -1, -1, -1}));
    cloth.particle_thickness.clear();
    EXPECT_EQ(touched_colliders(scene.cloths[0], scene.colliders, 0, places), std::vector<std::int16_t>(10, 0));
}

}  // namespace
}  // namespace drape
