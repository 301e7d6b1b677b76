// Statistics of a cloth with missing springs: a record per workgroup.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/spring.h"
#include "include/statistics.h"
#define MASKED
#include "include/statistics_pass.h"
