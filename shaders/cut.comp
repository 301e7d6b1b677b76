// Which springs and triangles the cutters cross at the end of a frame.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "shared/cut_types.h"
#include "include/cut.h"
#include "include/cut_pass.h"
