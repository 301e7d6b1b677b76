#pragma once

#include <array>

namespace drape {

/// The curves of a plot have Okabe and Ito's colours, which the colour-blind tell apart; yellow, too pale on white, is
/// left out.
inline constexpr std::array<const char*, 8> plot_colours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                            "#E69F00", "#56B4E9", "#000000", "#7F7F7F"};

}  // namespace drape
