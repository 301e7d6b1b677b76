// Solves the springs of one direction line by line; stiffness from an image; stores their tension; BDF2 where the control says so.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/line_types.h"
#include "include/line.h"
#define MASKED
#define TENSION
#define SECOND_ORDER
#include "include/line_pass.h"
