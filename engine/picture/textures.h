// The textures of cloths as shaders/include/texture.h reads them: each with all that are halved from it, in one buffer.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "drape/scene.h"
#include "picture/raster_cloth.h"
#include "shared/raster_types.h"

namespace drape {

class Textures {
  public:
    /// Takes what the cloths' appearances have; images that several share are stored once. An image is resampled in
    /// linear light to the next powers of two, at most 2048 a side, each pixel the mean of what it covers.
    explicit Textures(const std::vector<Cloth>& cloths);

    /// Returns two numbers for each texel, three half floats of linear colour: red below green, and blue.
    std::span<const glsl::uint> halves() const { return halves_; }
    /// Returns a cloth's place (ClothPush::texture); zeros without a texture.
    glsl::uvec4 place(const RasterCloth& cloth) const;

  private:
    struct Stored {
        SharedTexture image;
        glsl::uvec4 place;
    };
    void store(SharedTexture image);

    std::vector<Stored> stored_;
    std::vector<glsl::uint> halves_;
};

/// Returns a number from 0 to 65504 as a half float (IEEE 754 binary16), rounded to nearest.
std::uint16_t half_float(double value);

}  // namespace drape
