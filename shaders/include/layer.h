// Packs what is seen at a pixel, in the bytes of LayerPixel (engine/include/drape/frame.h).
#ifndef DRAPE_LAYER_H
#define DRAPE_LAYER_H

/// `normal`: unit, in the world. The depth is clip space's w, the distance along the camera's axis.
uvec4 layer_pixel(vec3 normal, uint id, float strain) {
    uint z = packSnorm2x16(vec2(normal.z, 0.0));  // in the lower half
    return uvec4(floatBitsToUint(1.0 / gl_FragCoord.w), packSnorm2x16(normal.xy), z | id << 16,
                 floatBitsToUint(strain));
}

#endif
