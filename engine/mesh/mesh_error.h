// Errors of meshes have no place in their text; the caller that asked for the mesh knows it.
#pragma once

#include "drape/error.h"

namespace drape {

struct MeshError : Error {
    using Error::Error;
};

}  // namespace drape
