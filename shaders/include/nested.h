// Nested boxes (docs/solvers.md, "Nested boxes at lone pins") solve the second system of include/line.h alone, along
// the lines of a box of particles around a held one, again and again.
#ifndef DRAPE_NESTED_H
#define DRAPE_NESTED_H

/// The box of the particles with |column - pin| <= radius.x and |row - pin| <= radius.y, within the sheet.
struct NestedBox {
    ivec2 first, size;
};

SHARED NestedBox nested_box(ivec2 pin, ivec2 radius, ivec2 grid) {
    ivec2 first = ivec2(pin.x > radius.x ? pin.x - radius.x : 0, pin.y > radius.y ? pin.y - radius.y : 0);
    ivec2 last = ivec2(pin.x + radius.x < grid.x ? pin.x + radius.x : grid.x - 1,
                       pin.y + radius.y < grid.y ? pin.y + radius.y : grid.y - 1);
    return NestedBox(first, ivec2(last.x - first.x + 1, last.y - first.y + 1));
}

/// Returns the `order`-th direction of a block's iteration; both diagonals come before rows and columns.
SHARED int nested_direction(int order) { return order < 2 ? order + 2 : order - 2; }

SHARED ivec2 nested_step(int direction) {
    return ivec2(direction == 1 ? 0 : direction == 3 ? -1 : 1, direction == 0 ? 0 : 1);
}

/// Returns the column of the box whose particles own no spring of a direction, since diagonals wrap around; -1: none.
SHARED int nested_seam(ivec2 step, int columns) {
    if (step.x == 0 || step.y == 0) return -1;
    return step.x > 0 ? columns - 1 : 0;
}

#endif
