// Products in a fixed order, since dot(), cross() and length() leave the order to the driver.
#ifndef DRAPE_VECTOR_H
#define DRAPE_VECTOR_H

SHARED float ordered_dot(vec3 a, vec3 b) {
    precise float sum = a.x * b.x + a.y * b.y + a.z * b.z;
    return sum;
}

/// Code that would divide several times by the same number multiplies by this instead.
SHARED float reciprocal(float x) {
    precise float inverse = 1.0f / x;
    return inverse;
}

SHARED vec3 ordered_cross(vec3 a, vec3 b) {
    precise vec3 product = vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
    return product;
}

#endif
