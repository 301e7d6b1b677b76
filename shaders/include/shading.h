// Every surface in the picture is shaded by this formula. tests/gpu/raster_test.cpp has it again in double precision.
//
//   radiance = albedo * O * (S (1 + n.u) / 2 + G (1 - n.u) / 2)   ambient: sky above, ground below (hemisphere light)
//            + sum over lights, V = share of the first light that arrives (shadow map), c = n.l:
//                L V albedo * c                      c > 0         Lambert
//                L V albedo * transmission * -c      c < 0         light through thin cloth
//            + L V c F D / (4 (l.h)^2)               c > 0, a < 1  highlight of the first light, h = unit(l + v):
//              D = a^2 / ((n.h)^2 (a^2 - 1) + 1)^2, F = 0.04       GGX's distribution of facets (Walter et al. 2007),
//                                                                  visible as of Kelemen and Szirmay-Kalos 2001
//            + albedo * S * sheen * (1 - n.v)^4                    fibres at grazing angles
//
// n: unit normal of the side that faces the eye, u: up in the world, l: unit vector to the light, v: unit vector to the
// eye, S, G: ambient of sky and ground, O: openness, the share of the surroundings that folds leave free, L: light
// colour times intensity, a: square of the roughness; all colours linear. tone.h makes the picture's colours of it.
#ifndef DRAPE_SHADING_H
#define DRAPE_SHADING_H

struct Surface {
    vec3 albedo;
    vec3 normal;
    vec3 to_eye;
    float transmission;
    float spread;  // a^2; 1: there is no highlight
    float sheen;
    float openness;
};

float cosine(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

float clamped(float x) { return x > 0.0f ? x : 0.0f; }

/// `rise`: n.u
vec3 ambient_radiance(Surface surface, float rise, vec3 sky, vec3 ground) {
    float grazing = 1.0f - clamped(cosine(surface.normal, surface.to_eye));
    float sheen = surface.sheen * grazing * grazing * grazing * grazing;
    float up = 0.5f + 0.5f * rise;
    return surface.albedo * (sky * (surface.openness * up + sheen) + ground * (surface.openness * (1.0f - up)));
}

/// One light's diffuse part. `arriving`: light colour times intensity times visibility.
vec3 light_radiance(Surface surface, vec3 to_light, vec3 arriving) {
    float facing = cosine(surface.normal, to_light);
    return surface.albedo * arriving * (facing > 0.0f ? facing : surface.transmission * -facing);
}

/// The halfway vector has no unit length here, by which only one division is left.
vec3 highlight_radiance(Surface surface, vec3 to_light, vec3 arriving) {
    vec3 halfway = to_light + surface.to_eye;
    float squared = cosine(halfway, halfway), along = clamped(cosine(surface.normal, halfway));
    float facing = clamped(cosine(surface.normal, to_light));
    float facets = max(squared + along * along * (surface.spread - 1.0f), 1e-6f);
    return arriving * (facing * 0.04f * surface.spread * squared / (facets * facets));
}

#endif
