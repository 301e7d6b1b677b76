// The shading formula of every surface in the picture, readable by GLSL and C++.
//
//   radiance = albedo * A * (3 + n.y) / 4                          ambient: sky above, 1/2 of it from below
//            + sum over lights, V = share of the light that arrives (shadow map), c = n.l:
//                L V albedo * c                      c > 0         Lambert
//                L V albedo * transmission * -c      c < 0         light through thin cloth
//                L V gloss * (n.h)^32                c > 0         Blinn-Phong highlight, h = unit(l + v)
//            + albedo * A * sheen * (1 - n.v)^4                    fibres at grazing angles
//
// n: unit normal of the side that faces the eye, l: unit vector to the light, v: unit vector to the eye, A:
// ambient, L: light colour times intensity; all colours linear. The attachment clamps to 1 and encodes sRGB.
#ifndef DRAPE_SHADING_H
#define DRAPE_SHADING_H

#ifdef __cplusplus
#include "shared/glsl_types.h"
namespace drape::glsl {
#endif

struct Surface {
    vec3 albedo;
    vec3 normal;
    vec3 to_eye;
    float transmission;
    float gloss;
    float sheen;
};

SHARED float cosine(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

SHARED float clamped(float x) { return x > 0.0f ? x : 0.0f; }

SHARED vec3 ambient_radiance(Surface surface, vec3 ambient) {
    float grazing = 1.0f - clamped(cosine(surface.normal, surface.to_eye));
    float sheen = surface.sheen * grazing * grazing * grazing * grazing;
    return surface.albedo * ambient * ((3.0f + surface.normal.y) / 4.0f + sheen);
}

/// One light's part. `arriving`: light colour times intensity times visibility.
SHARED vec3 light_radiance(Surface surface, vec3 to_light, vec3 arriving) {
    float facing = cosine(surface.normal, to_light);
    if (!(facing > 0.0f)) return surface.albedo * arriving * (surface.transmission * -facing);
    vec3 halfway = to_light + surface.to_eye;
    float squared = cosine(halfway, halfway);
    float power =
        squared > 0.0f && surface.gloss > 0.0f ? clamped(cosine(surface.normal, halfway)) / sqrt(squared) : 0.0f;
    // To the 32nd; no loop, because the default device's compiler unrolls none.
    power = power * power;
    power = power * power;
    power = power * power;
    power = power * power;
    power = power * power;
    return (surface.albedo * facing + vec3(1.0f, 1.0f, 1.0f) * (surface.gloss * power)) * arriving;
}

#ifdef __cplusplus
}  // namespace drape::glsl
#endif

#endif
