// Relaxes one parity of one spring direction; stiffness from an image, which stores the tension.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/spring.h"
#define MASKED
#define TENSION
#include "include/spring_pass.h"
