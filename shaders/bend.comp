// Relaxes one colour of the bending elements of one axis.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/bend.h"
#include "include/spring.h"
#include "include/bend_pass.h"
