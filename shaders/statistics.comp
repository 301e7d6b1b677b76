// Statistics of a cloth: a record per workgroup.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/spring.h"
#include "include/statistics.h"
#include "include/statistics_pass.h"
