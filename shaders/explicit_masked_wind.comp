// Explicit micro-step under gravity, damping, springs and wind; stiffness from an image.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/bend.h"
#include "include/explicit.h"
#include "include/spring.h"
#include "include/verlet.h"
#include "include/wind.h"
#define MASKED
#define WINDY
#include "include/explicit_pass.h"
