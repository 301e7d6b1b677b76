#include "run/run.h"

namespace drape {

const char* program_commit() {
    return
#include "commit.inc"
        ;
}

}  // namespace drape
