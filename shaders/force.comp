// Verlet prediction under gravity and damping.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/verlet.h"
#include "include/force_pass.h"
