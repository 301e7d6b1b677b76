// Planes are drawn with a grid of lines and fade with distance into the backdrop.
#ifndef DRAPE_PLANE_H
#define DRAPE_PLANE_H

/// Share of a pixel that the grid's lines cover; they are about one and a half pixels wide. `cell`: place in units of
/// the lines' distance; `width`: by how much it changes from pixel to pixel.
float grid_lines(vec2 cell, vec2 width) {
    vec2 line = 1.0 - min(abs(fract(cell - 0.5) - 0.5) / (0.75 * width), 1.0);
    // Lines closer than a few pixels would only flicker, so they are faded.
    vec2 visible = clamp(1.0 - 6.0 * width, 0.0, 1.0);
    return max(line.x * visible.x, line.y * visible.y);
}

/// Colour of a pixel of which lines cover the share `lines`.
vec3 lined(vec3 color, float lines) { return mix(color, color * 0.75, lines); }

/// Share of the backdrop at a distance from the fade's centre in units of its radius.
float faded(float away) { return smoothstep(0.25, 1.0, away); }

#endif
