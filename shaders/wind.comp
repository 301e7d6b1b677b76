// Force of the wind on every particle.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/triangles.h"
#include "include/wind.h"
#include "include/wind_pass.h"
