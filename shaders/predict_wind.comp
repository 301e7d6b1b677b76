// Prediction of the line solver in second order, under gravity, damping and wind.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/line_types.h"
#include "shared/simulation_types.h"
#include "include/bdf2.h"
#include "include/verlet.h"
#define WINDY
#include "include/predict_pass.h"
