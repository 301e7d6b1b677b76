// Ends a frame: X += d, so that the position image holds the state that is drawn and read back.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/verlet.h"
#include "include/advance_pass.h"
