// Relaxes one parity of one spring direction.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/spring.h"
#include "include/spring_pass.h"
