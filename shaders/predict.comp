// Prediction of the line solver in second order, under gravity and damping.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/line_types.h"
#include "shared/simulation_types.h"
#include "include/bdf2.h"
#include "include/verlet.h"
#include "include/predict_pass.h"
