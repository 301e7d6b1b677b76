// The rows of what only pictures know.
#pragma once

#include "scene/shared_rows.h"

namespace drape::rows {

inline const Object<Appearance> appearance{
    "appearance",
    "For pictures only.",
    {
        {"front", &Appearance::front, color, "sRGB of the side of u x v."},
        {"back", &Appearance::back, optional<Vec3>(color),
         "sRGB of the other side. Absent: 0.85 of the front's, or the texture."},
        {"pattern", &Appearance::pattern, choice<Pattern>(pattern_spellings),
         "Plain colour, or squares or stripes (along columns) of it and of `second`, each an eighth of the cloth's "
         "shorter side wide."},
        {"second", &Appearance::second, color, "sRGB of the pattern's other squares or stripes, on both sides."},
        {"texture", &Appearance::texture, without_default(text()),
         "PNG file that spans the cloth, its first row at row 0, instead of colour and pattern; names are as of start. "
         "It is resampled to powers of two, at most 2048 pixels a side. The back shows it too, where `back` is "
         "absent."},
        {"roughness", &Appearance::roughness, number({0.1, 1.0, false}),
         "Of the surface: 1 is without a highlight, fabrics shine from about 0.7 on down, silk at 0.35. A fabric has "
         "its own."},
        {"sheen", &Appearance::sheen, number(unit_interval),
         "Light of the sky that fibres scatter where they are seen at grazing angles: velvet has 1. A fabric has its "
         "own."},
        {"weave", &Appearance::weave, number(not_negative),
         "Metres from thread to thread of a plain weave. Threads finer than about two pixels are not seen. 0: none are "
         "drawn."},
        {"hem", &Appearance::hem, number(not_negative),
         "Metres: width of a sewn hem along the rim of the grid, at most a quarter of the shorter side; not of a cloth "
         "with an outline. 0: none."},
    },
    check_appearance};

inline const Object<CameraKey> camera_key{
    "camera_key",
    "One key of a camera that moves.",
    {
        {"t", &CameraKey::time, number(any_number), key_time_help, key_time_text},
        {"position", &CameraKey::position, vec3, "Metres.", "a position of 3 numbers"},
        {"target", &CameraKey::target, vec3, "Metres; not the position.", "a target of 3 numbers"},
    },
    check_camera_key};

inline const Object<Camera> camera{
    "camera",
    "A pinhole camera, upright. Where z is up, the default position is [0, -3, 1.5] and the target [0, 0, 1].",
    {
        {"position", &Camera::position, turned(vec3), "Metres. Ignored (with a warning) beside keys."},
        {"target", &Camera::target, turned(vec3),
         "Metres: the point in the middle of the picture; not the position. Ignored (with a warning) beside keys."},
        {"fov", &Camera::fov, number({0.0, 170.0, true}), "Degrees, vertical field of view."},
        {"keys", &Camera::keys, keys_in_time<CameraKey>(camera_key),
         "A camera that moves: its position and its target go smoothly through the keys, as a path does."},
    },
    check_camera};

inline const Object<DirectionalLight> light{
    "light",
    "A directional light.",
    {
        {"direction", &DirectionalLight::direction, turned(direction),
         "The way the light travels. Where z is up, the default is turned with the world."},
        {"color", &DirectionalLight::color, color, "sRGB."},
        {"intensity", &DirectionalLight::intensity, number(not_negative), "Factor on the colour."},
    }};

inline const Object<ImageSettings> image{
    "image",
    "The pictures.",
    {
        {"size", &ImageSettings::size, two_integers(1, 16384), "Pixels: width, height."},
        {"samples", &ImageSettings::samples, one_of({1, 4}), "Samples per pixel."},
        {"background", &ImageSettings::background, color, "sRGB."},
        {"fixtures", &ImageSettings::fixtures, boolean(),
         "Whether poles, rails and knobs are drawn that pinned cloth hangs on."},
        {"blades", &ImageSettings::blades, boolean(), "Whether cutters are drawn while they are active."},
        {"alpha", &ImageSettings::alpha, boolean(),
         "Whether pictures have an alpha channel, and neither backdrop nor floor."},
        {"motion_blur", &ImageSettings::motion_blur, integer(1, 256),
         "Moments at which each picture is drawn, spread over half the time from frame to frame, up to the frame's "
         "own: "
         "it is their mean in linear light, and takes as many times as long. 1: no blur."},
    }};

}  // namespace drape::rows
