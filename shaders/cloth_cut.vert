// A cut cloth's particles and the vertices on its cut springs.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/raster_types.h"
#include "shared/cut_types.h"
#include "include/raster_frame.h"
#define CUT
#include "include/cloth_vertex_main.h"
