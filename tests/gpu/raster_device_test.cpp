// The raster pass makes the same picture where it works in another way, as on other devices.
#include <gtest/gtest.h>

#include "raster_picture.h"

namespace drape {
namespace {

/// Where shaders cannot load samples, these are resolved first, and rounded once more.
TEST_F(Raster, ResolvedSamplesMakeTheSamePicture) {
    SceneDescription scene = floor_scene();
    scene.colliders.push_back(painted(Sphere{{0.2, 0.3, 0}, 0.3}, {0.4, 0.5, 0.6}));
    const std::vector<DrawnCloth> cloths{flat_cloth({0, 0.8, 0}, {1, 0.2, 0}, {0, 0.1, -1}, {0, 1, 0}, red, blue, 9)};
    const std::string_view without[] = {"samples_in_shaders"};
    const vulkan::Device resolving(test::gpu().instance, test::gpu().device.info().uuid_text(), without);
    EXPECT_FALSE(resolving.capabilities().samples_in_shaders);
    Shot shot{.samples = 4, .options = {.shadow = true}};
    const Picture loaded = draw(scene, cloths, shot);
    shot.device = &resolving;
    const Picture resolved = draw(scene, cloths, shot);
    std::size_t other = 0;
    for (std::size_t i = 0; i < loaded.bytes.size(); ++i) {
        ASSERT_NEAR(loaded.bytes[i], resolved.bytes[i], 1) << i;
        other += loaded.bytes[i] != resolved.bytes[i];
    }
    std::printf("[ measured ] %zu of %zu bytes differ\n", other, loaded.bytes.size());
    EXPECT_LT(other, loaded.bytes.size() / 100);
}

/// Descriptor sets, and storage buffers in place of texel buffers, which a shadow reads, draw the same bytes.
TEST_F(Raster, WithoutPushDescriptorsAndTexelBuffersIsTheSamePicture) {
    SceneDescription scene = floor_scene();
    scene.colliders.push_back(painted(Sphere{{0.2, 0.3, 0}, 0.3}, {0.4, 0.5, 0.6}));
    const std::vector<DrawnCloth> cloths{flat_cloth({0, 0.8, 0}, {1, 0.2, 0}, {0, 0.1, -1}, {0, 1, 0}, red, blue, 9)};
    const std::string_view without[] = {"push_descriptors", "texel_buffers"};
    const vulkan::Device bare(test::gpu().instance, test::gpu().device.info().uuid_text(), without);
    Shot shot{.samples = 4, .options = {.shadow = true}};
    const Picture usual = draw(scene, cloths, shot);
    shot.device = &bare;
    EXPECT_EQ(draw(scene, cloths, shot).bytes, usual.bytes);
}

/// Where the device is a GPU, fragments read the frame's constants where they are.
TEST_F(Raster, ConstantsByTriangleOrFromTheirBufferMakeTheSamePicture) {
    SceneDescription scene = floor_scene();
    scene.lights.push_back({{1, -0.3, 0}, red, 0.3});
    scene.ambient_ground = {0.1, 0.05, 0.2};
    scene.colliders.push_back(painted(Sphere{{0.2, 0.3, 0}, 0.3}, {0.4, 0.5, 0.6}));
    scene.colliders.push_back(painted(Plane{{0, 0, 1}, -2}, blue));
    DrawnCloth cloth = flat_cloth({0, 0.8, 0}, {1, 0.2, 0}, {0, 0.1, -1}, {0, 1, 0}, red, blue, 9);
    cloth.appearance.pattern = Pattern::checker;
    cloth.appearance.second = {0.2, 0.9, 0.4};
    for (const View view : {View::shaded, View::wire})
        for (const bool shadow : {false, true}) {
            Shot shot{.samples = 4, .options = {.shadow = shadow, .view = {.kind = view}}};
            shot.options.constants_by_triangle = true;
            const Picture by_triangle = draw(scene, {cloth}, shot);
            shot.options.constants_by_triangle = false;
            EXPECT_EQ(draw(scene, {cloth}, shot).bytes, by_triangle.bytes);
            scene.lights[0].color = green;
            EXPECT_NE(draw(scene, {cloth}, shot).bytes, by_triangle.bytes);
            scene.lights[0].color = white;
        }
}

}  // namespace
}  // namespace drape
