// The look of a cloth's threads and of its hem, as a function of the place on the material (metres along columns and
// rows), so that it goes with the cloth. Both change the brightness by a factor and tilt the normal; what is finer than
// pixels fades out to its mean.
#ifndef DRAPE_FABRIC_H
#define DRAPE_FABRIC_H

struct Relief {
    vec2 slope;  // rise towards the eye per length along columns, rows
    float shade;
};

/// Threads of the plain weave: in every second cell one along the columns' direction lies on top, in the others one
/// along the rows'. Seen across it is a parabola, seen along an arch a third as high; its sides are dark. The mean of
/// the shade is 1, that of the slopes 0. `spacing`: metres from thread to thread; `width`: metres per pixel.
Relief woven(vec2 material, vec2 width, float spacing) {
    vec2 threads = material / spacing, cell = floor(threads), at = 2.0 * (threads - cell) - 1.0;
    bool warp = mod(cell.x + cell.y, 2.0) < 0.5;
    vec2 rise = warp ? vec2(0.2, 0.6) : vec2(0.6, 0.2);
    float side = warp ? at.y : at.x;
    float visible = clamp(1.6 - 4.0 * max(width.x, width.y) / spacing, 0.0, 1.0);
    return Relief(-visible * rise * at, 1.0 + visible * 0.45 * (1.0 / 3.0 - side * side));
}

/// Returns the share of a tent of this height and half width around 0 that is left where pixels are `width` wide.
float tent(float away, float half_width, float width) {
    float wide = max(half_width, width);
    return max(1.0 - abs(away) / wide, 0.0) * half_width / wide;
}

/// The rim is folded over and sewn: it is as dark as two layers are, ends in a crease, rounds off at the rim and has a
/// row of stitches. `size`: metres along columns, rows; `hem`: its width, m.
Relief hemmed(vec2 material, vec2 width, vec2 size, float hem) {
    vec2 middle = 0.5 * size, from_rim = middle - abs(material - middle);
    bool beside = from_rim.x < from_rim.y;
    float away = max(beside ? from_rim.x : from_rim.y, 0.0), along = beside ? material.y : material.x;
    float pixel = beside ? width.x : width.y;
    float inside = clamp(0.5 + (hem - away) / max(pixel, 1e-6), 0.0, 1.0);
    float crease = tent(away - hem, 0.1 * hem, pixel), rim = tent(away, 0.2 * hem, pixel);
    float gaps = abs(fract(along / (0.5 * hem)) - 0.5);
    float stitched = clamp(1.0 - 4.0 * (beside ? width.y : width.x) / hem, 0.0, 1.0);
    float stitch = tent(away - 0.75 * hem, 0.06 * hem, pixel) * mix(0.7, gaps < 0.35 ? 1.0 : 0.0, stitched);
    // The surface falls from the hem to the single layer, and to the rim.
    float fall = 0.6 * crease - 0.9 * rim;
    vec2 inwards = beside ? vec2(sign(middle.x - material.x), 0.0) : vec2(0.0, sign(middle.y - material.y));
    return Relief(-fall * inwards, (1.0 - 0.07 * inside) * (1.0 - 0.35 * crease) * (1.0 - 0.4 * stitch));
}

/// Returns the normal of a surface with this relief. `along`: how the place in the world changes with that on the
/// material, by columns and rows, both of unit length where the cloth is not stretched.
vec3 tilted(vec3 normal, vec3 along[2], vec2 slope) { return normal - along[0] * slope.x - along[1] * slope.y; }

#endif
