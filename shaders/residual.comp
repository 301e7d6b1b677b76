// Stretch error within a substep: a record per workgroup.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/residual.h"
#include "include/spring.h"
#include "include/residual_pass.h"
