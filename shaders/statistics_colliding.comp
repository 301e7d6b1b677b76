// Statistics of a cloth among colliders: a record per workgroup.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/spring.h"
#include "include/statistics.h"
#include "include/colliders.h"
#define COLLIDING
#include "include/statistics_pass.h"
