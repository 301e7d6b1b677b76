// Springs relaxed pair by pair.
#include "native_vectors.h"

namespace drape::native {

namespace {

/// `count` pairs, `stride` columns apart, of one row's particles with those `to_second` further in memory.
template <int stride>
void relax(const SheetView& sheet, const SpringPush& push, std::ptrdiff_t first_at, std::ptrdiff_t to_second, int count,
           float share) {
    const float rest_length = push.rest_length, compression = push.compression, compliance = push.compliance;
#pragma GCC ivdep
    for (int k = 0; k < count; ++k) {
        const std::ptrdiff_t first = first_at + stride * k, second = first + to_second;
        const float weight_first = sheet.weight[first], weight_second = sheet.weight[second];
        const vec3 moved_first = load(sheet.displacement, first), moved_second = load(sheet.displacement, second);
        const vec3 edge =
            spring_edge(load(sheet.position, first), load(sheet.position, second), moved_first, moved_second);
        const SpringResult result =
            project_spring(edge, weight_first + weight_second, rest_length, share, compression, compliance, 0.0f);
        store(sheet.displacement, first, moved_by(moved_first, result.correction, -weight_first));
        store(sheet.displacement, second, moved_by(moved_second, result.correction, weight_second));
    }
}

}  // namespace

void NATIVE_VARIANT::spring_rows(const SheetView& sheet, const SpringPush& push, Rows rows) {
    const std::ptrdiff_t to_second = push.offset.y * sheet.pitch + push.offset.x;
    const int last = push.grid.x - 1;
    for (int pair = rows.first; pair < rows.last; ++pair) {
        const ivec2 owner = spring_owner({0, pair}, push.offset, push.parity_axis, push.parity);
        const std::ptrdiff_t first = sheet.place(owner.x, owner.y);
        if (push.parity_axis == 0) {
            const float share = border_share({1, owner.y}, push.offset, push.grid);
            relax<2>(sheet, push, first, to_second, push.pair_count.x, share);
        } else if (push.offset.x == 0) {  // borders have half
            relax<1>(sheet, push, first, to_second, 1, 0.5f);
            relax<1>(sheet, push, first + 1, to_second, last - 1, 1.0f);
            relax<1>(sheet, push, first + last, to_second, 1, 0.5f);
        } else {
            relax<1>(sheet, push, first, to_second, push.pair_count.x, 1.0f);
        }
    }
}

}  // namespace drape::native
