// Which springs and triangles the cutters cross, on a cloth with missing ones.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "shared/cut_types.h"
#include "include/cut.h"
#define MASKED
#include "include/cut_pass.h"
