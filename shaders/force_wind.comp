// Verlet prediction under gravity, damping and wind.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/verlet.h"
#define WINDY
#include "include/force_pass.h"
