#pragma once

#include "drape/spelling.h"

namespace drape {

enum class View {
    shaded,   ///< lit, with the cloths' colours
    stretch,  ///< the strain of the most stretched stretch spring at each particle, as a heat map
    warp,     ///< strain along the cloth's u (growing column), of the most strained spring at each particle
    weft,     ///< the same along its v (growing row)
    wire,     ///< lit, with the edges of the triangles
    normals,  ///< 0.5 + 0.5 n as sRGB, n: the world's x y z of the normal of the side that faces the camera
};
inline constexpr Spelling<View> view_spellings[] = {{"shaded", View::shaded}, {"stretch", View::stretch},
                                                    {"warp", View::warp},     {"weft", View::weft},
                                                    {"wire", View::wire},     {"normals", View::normals}};

struct PictureView {
    View kind = View::shaded;
    double range = 0;  ///< strain at the end of the colour map, above 0; 0: chosen by the scene
    bool shows_strain() const { return kind == View::stretch || kind == View::warp || kind == View::weft; }
};

}  // namespace drape
