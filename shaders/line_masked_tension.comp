// Solves the springs of one direction line by line; stiffness from an image; stores their tension.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/line_types.h"
#include "include/line.h"
#define MASKED
#define TENSION
#include "include/line_pass.h"
