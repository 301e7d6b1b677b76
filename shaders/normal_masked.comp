// Normals of a cloth with missing triangles.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/triangles.h"
#include "include/wind.h"
#define MASKED
#include "include/normal_pass.h"
