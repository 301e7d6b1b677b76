// The look of planes: a grid of lines, which fades into the backdrop with distance.
#ifndef DRAPE_PLANE_H
#define DRAPE_PLANE_H

/// Returns the share of a pixel that the grid's lines cover; they are about one and a half pixels wide. `cell`: place
/// in units of the lines' distance; `width`: how much it changes from pixel to pixel.
float grid_lines(vec2 cell, vec2 width) {
    vec2 line = 1.0 - min(abs(fract(cell - 0.5) - 0.5) / (0.75 * width), 1.0);
    // Lines closer than a few pixels would only flicker, so they fade out.
    vec2 visible = clamp(1.0 - 6.0 * width, 0.0, 1.0);
    return max(line.x * visible.x, line.y * visible.y);
}

/// Returns the colour of a pixel that lines cover by the share `lines`.
vec3 lined(vec3 color, float lines) { return mix(color, color * 0.75, lines); }

/// Returns the share of the backdrop at a distance from the fade's centre, in units of its radius.
float faded(float away) { return smoothstep(0.25, 1.0, away); }

#endif
