// A collider or the backdrop, without shadows.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/raster_types.h"
#include "include/raster_frame.h"
#include "include/shading.h"
#include "include/raster_lights.h"
#include "include/collider_shade.h"
