#include "picture/color_map.h"

#include <algorithm>

namespace drape {

const ColorMap viridis{{0x440154, 0x470d60, 0x48186a, 0x482374, 0x472d7b, 0x453681, 0x424086, 0x3f4989, 0x3b528b,
                        0x375a8d, 0x33638d, 0x2f6a8e, 0x2c728e, 0x297a8e, 0x26818e, 0x23898e, 0x21908c, 0x1f988b,
                        0x1f9f88, 0x21a685, 0x28ae80, 0x31b57b, 0x3ebc74, 0x4cc26c, 0x5dc963, 0x6ece58, 0x82d34c,
                        0x96d83f, 0xabdc32, 0xc0df24, 0xd5e21a, 0xeae51a, 0xfde725}};

const ColorMap cool_warm{{0x3b4cc0, 0x445acc, 0x4d68d7, 0x5775e1, 0x6282ea, 0x6c8ef1, 0x779af7, 0x82a5fb, 0x8db0fe,
                          0x98b9ff, 0xa3c2fe, 0xaec9fc, 0xb8d0f9, 0xc2d5f4, 0xccd9ee, 0xd5dbe6, 0xdddddd, 0xe5d8d1,
                          0xecd3c5, 0xf1ccb9, 0xf4c4ad, 0xf7bba0, 0xf7b194, 0xf7a687, 0xf49a7b, 0xf18d6f, 0xec7f63,
                          0xe57058, 0xde604d, 0xd55042, 0xcb3e38, 0xc0282f, 0xb40426}};

std::array<double, 3> color_at(const ColorMap& map, double place) {
    const double last = static_cast<double>(map.colors.size()) - 1;
    const double at = std::clamp(place, 0.0, 1.0) * last;
    const auto low = std::min(static_cast<std::size_t>(at), map.colors.size() - 2);
    const double part = at - static_cast<double>(low);
    std::array<double, 3> color{};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const auto level = [&](std::size_t i) {
            return static_cast<double>(map.colors[i] >> (16 - 8 * channel) & 0xffu);
        };
        color[channel] = level(low) + part * (level(low + 1) - level(low));
    }
    return color;
}

}  // namespace drape
