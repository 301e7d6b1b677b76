// What is wrong with a mesh is told without a place; whoever asked for it knows that.
#pragma once

#include "drape/error.h"

namespace drape {

struct MeshError : Error {
    using Error::Error;
};

}  // namespace drape
