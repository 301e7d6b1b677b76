// How a scene looks: the part of its values (drape/scene.h) that only pictures know.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "drape/spelling.h"
#include "drape/vec3.h"

namespace drape {

enum class Pattern { plain, checker, stripes };
inline constexpr Spelling<Pattern> pattern_spellings[] = {
    {"plain", Pattern::plain}, {"checker", Pattern::checker}, {"stripes", Pattern::stripes}};

/// A picture that a cloth shows: 8-bit sRGB, rows from the top, tightly packed.
struct TextureImage {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgb;
    bool operator==(const TextureImage&) const = default;
};

/// An image that several cloths may share; equal are those of the same pixels.
struct SharedTexture : std::shared_ptr<const TextureImage> {
    using std::shared_ptr<const TextureImage>::shared_ptr;
    SharedTexture(std::shared_ptr<const TextureImage> image) : shared_ptr(std::move(image)) {}
    bool operator==(const SharedTexture& other) const {
        return get() == other.get() || (get() && other.get() && *get() == *other.get());
    }
};

struct Appearance {
    Vec3 front{0.80, 0.10, 0.10};  ///< sRGB 0..1
    std::optional<Vec3> back{};    ///< nothing: as the front, a little darker
    Pattern pattern = Pattern::checker;
    Vec3 second{0.93, 0.89, 0.80};  ///< colour of the pattern's other squares or stripes, on both sides
    double roughness = 1;           ///< of the surface, 0.1..1: 1 has no highlight
    double sheen = 0.3;             ///< 0..1: light of the sky that fibres scatter at grazing angles
    double weave = 0;               ///< m from thread to thread; 0: none are drawn
    double hem = 0;                 ///< m: width of the hem along the grid's rim; 0: none
    /// A PNG file. The scene reader reads it; whoever fills this otherwise calls `read_file` (drape/scene_reader.h).
    std::string texture{};
    SharedTexture image{};  ///< what was read; null without a texture
    bool operator==(const Appearance&) const = default;
};
/// A back of which nothing says what it is shows so much of the front's sRGB.
inline constexpr double back_share = 0.85;
inline Vec3 back_of(const Appearance& appearance) {
    const Vec3& front = appearance.front;
    return appearance.back.value_or(Vec3{back_share * front[0], back_share * front[1], back_share * front[2]});
}

/// One key of a camera that moves.
struct CameraKey {
    double time = 0;  ///< s
    Vec3 position{0, 1.5, 3};
    Vec3 target{0, 1, 0};
    bool operator==(const CameraKey&) const = default;
};

struct Camera {
    Vec3 position{0, 1.5, 3};
    Vec3 target{0, 1, 0};
    double fov = 40.0;  ///< vertical, degrees
    Vec3 up{0, 1, 0};   ///< what points up in the picture; picture/framing.h sets it to the scene's
    /// Strictly increasing in time; empty: it stands still. Positions and targets go as paths do (world/motion.h).
    std::vector<CameraKey> keys{};
    bool operator==(const Camera&) const = default;
};

struct DirectionalLight {
    Vec3 direction{0.75, -0.9, -0.5};  ///< direction in which the light travels; unit length after reading
    Vec3 color{1, 0.97, 0.91};         ///< sRGB 0..1
    double intensity = 1.2;
    bool operator==(const DirectionalLight&) const = default;
};

/// Returns a warm key light from the left, high and a little in front, and a cool fill light from the right.
inline std::vector<DirectionalLight> default_lights() {
    return {DirectionalLight{}, {{-0.8, -0.35, -0.5}, {0.72, 0.84, 1}, 0.22}};
}

struct ImageSettings {
    std::array<std::uint32_t, 2> size{1280, 720};
    std::uint32_t samples = 4;          ///< 1 or 4
    Vec3 background{0.86, 0.89, 0.93};  ///< sRGB 0..1
    bool fixtures = true;           ///< draws poles, rails and knobs that pinned cloth hangs on (picture/fixtures.h)
    bool blades = true;             ///< draws cutters while they are active
    bool alpha = false;             ///< no backdrop and no floor: pictures have an alpha channel
    std::uint32_t motion_blur = 1;  ///< moments at which a picture is drawn, of which it is the mean; 1: no blur
    bool operator==(const ImageSettings&) const = default;
};
/// Those moments are spread over so much of the time from frame to frame, up to the frame's own: a shutter of 180
/// degrees.
inline constexpr double open_shutter = 0.5;

}  // namespace drape
