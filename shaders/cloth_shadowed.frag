// A cloth under the first light's shadow map.
#version 460
#extension GL_GOOGLE_include_directive : require
#define SHADOWED
#include "shared/raster_types.h"
#include "include/raster_frame.h"
#include "include/shading.h"
#include "include/raster_lights.h"
#include "include/cloth_shade.h"
