// Errors of meshes are told without a place; whoever asked for the mesh knows it.
#pragma once

#include "drape/error.h"

namespace drape {

struct MeshError : Error {
    using Error::Error;
};

}  // namespace drape
