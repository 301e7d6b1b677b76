// Relaxes one parity of one spring direction; with XPBD multipliers.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/spring.h"
#define MULTIPLIED
#include "include/spring_pass.h"
