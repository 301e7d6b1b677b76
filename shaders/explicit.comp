// Explicit micro-step under gravity, damping and springs.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/bend.h"
#include "include/explicit.h"
#include "include/spring.h"
#include "include/verlet.h"
#include "include/wind.h"
#include "include/explicit_pass.h"
