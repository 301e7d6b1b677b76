// Ends a frame of an odd number of explicit steps: X += d, and both go back to the images that the next frame starts
// from.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/verlet.h"
#define HOME
#include "include/advance_pass.h"
