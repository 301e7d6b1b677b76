// Solves the springs of one direction line by line; stores their tension.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/line_types.h"
#include "include/line.h"
#define TENSION
#include "include/line_pass.h"
