// The triangles around a particle. Cell (i, j) has the corners (i, j) (i+1, j) (i, j+1) (i+1, j+1); its upper
// triangle is the first three, its lower one (i+1, j) (i+1, j+1) (i, j+1).
#ifndef DRAPE_TRIANGLES_H
#define DRAPE_TRIANGLES_H

const int triangles_around_particle = 6;

/// Returns triangle k (0..5) around a particle, in the order of every sum over triangles. xy: its cell relative to the
/// particle; z: 1 for the upper and 2 for the lower triangle (its bit in the cell image).
SHARED ivec4 triangle_around(int k) {
    if (k == 0) return ivec4(-1, -1, 2, 0);
    if (k == 1) return ivec4(0, -1, 1, 0);
    if (k == 2) return ivec4(0, -1, 2, 0);
    if (k == 3) return ivec4(-1, 0, 1, 0);
    if (k == 4) return ivec4(-1, 0, 2, 0);
    return ivec4(0, 0, 1, 0);
}

/// Returns corner (0..2) of a cell's upper (1) or lower (2) triangle, relative to the cell.
SHARED ivec2 triangle_corner(int which, int corner) {
    if (which == 1) return ivec2(corner == 1 ? 1 : 0, corner == 2 ? 1 : 0);
    return ivec2(corner == 2 ? 0 : 1, corner == 0 ? 0 : 1);
}

/// Returns the index of the corner that lies at `offset` from the triangle's cell.
SHARED int corner_of_triangle(int which, ivec2 offset) {
    for (int corner = 0; corner < 2; ++corner) {
        ivec2 at = triangle_corner(which, corner);
        if (at.x == offset.x && at.y == offset.y) return corner;
    }
    return 2;
}

SHARED bool cell_inside(ivec2 cell, ivec2 grid) {
    return cell.x >= 0 && cell.y >= 0 && cell.x < grid.x - 1 && cell.y < grid.y - 1;
}

#endif
