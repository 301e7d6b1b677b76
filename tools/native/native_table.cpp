#define NATIVE_NAME_OF(variant) variant##_kernels
#define NATIVE_NAME(variant) NATIVE_NAME_OF(variant)

#include "native_vectors.h"

namespace drape::native {

const Kernels& NATIVE_NAME(NATIVE_VARIANT)() {
    using namespace NATIVE_VARIANT;
    static constexpr Kernels kernels{prepare_explicit, explicit_rows, force_rows, predict_rows,
                                     advance_rows,     spring_rows,   solve_lines};
    return kernels;
}

}  // namespace drape::native
