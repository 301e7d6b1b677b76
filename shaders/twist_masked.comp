// Relaxes the twist of one colour of the cells; stiffness from an image.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/simulation_types.h"
#include "include/bend.h"
#include "include/spring.h"
#define MASKED
#include "include/twist_pass.h"
