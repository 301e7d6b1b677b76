// Maps radiance to the picture's values, for GLSL and C++: a soft shoulder above a knee, then the sRGB transfer
// function (IEC 61966-2-1). Below the knee colours stay as the scene gives them. The shoulder is Reinhard's operator
// with a white point ("Photographic Tone Reproduction for Digital Images", 2002, equation 4) on the radiance above the
// knee, in units of the rest to white: it leaves the knee at slope 1 and reaches 1 at `tone_white`.
#ifndef DRAPE_TONE_H
#define DRAPE_TONE_H

#include "shared/glsl_types.h"

#ifdef __cplusplus
namespace drape::glsl {
#endif

const float tone_knee = 0.75f;
const float tone_white = 2.5f;

SHARED float toned(float radiance) {
    float white = (tone_white - tone_knee) / (1.0f - tone_knee);
    float above = (radiance - tone_knee) / (1.0f - tone_knee);
    float shoulder = above * (1.0f + above / (white * white)) / (1.0f + above);
    return above > 0.0f ? tone_knee + (1.0f - tone_knee) * shoulder : radiance;
}

/// Returns the radiance that is shown as `shown` (0..1), so that a colour looks as the scene states it.
SHARED float untoned(float shown) {
    float white = (tone_white - tone_knee) / (1.0f - tone_knee);
    float above = (shown - tone_knee) / (1.0f - tone_knee), left = 1.0f - above;
    float solved = 0.5f * white * white * (sqrt(left * left + 4.0f * above / (white * white)) - left);
    return above > 0.0f ? tone_knee + (1.0f - tone_knee) * solved : shown;
}

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
