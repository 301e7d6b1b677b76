// Stretch error within a substep of a cloth with missing springs: a record per workgroup.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/residual.h"
#include "include/spring.h"
#define MASKED
#include "include/residual_pass.h"
