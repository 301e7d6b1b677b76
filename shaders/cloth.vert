// A cloth's particles as vertices: the index buffer alone drives it, position and normal come from the images.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/raster_types.h"
#include "include/raster_frame.h"
#include "include/cloth_vertex_main.h"
