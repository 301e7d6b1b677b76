// Solves the springs of one direction line by line.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/line_types.h"
#include "include/line.h"
#include "include/line_pass.h"
