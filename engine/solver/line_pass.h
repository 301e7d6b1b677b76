// The line solver: all springs of one direction, a line at a time; its control and its prediction in second order.
#pragma once

#include "solver/pass_kit.h"

namespace drape {

/// Decides whether the substep is BDF2 or backward Euler: reads and writes the control.
void add_line_control(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step);

/// Reads and writes position, displacement, their remainders and the history; reads the control, and wind_force when
/// the scene has wind.
void add_predict(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step);

/// Reads position, reads and writes displacement and the direction's tension; reads spring shares and updates the
/// control where the cloth has them.
void add_line(graph::Graph& graph, Pipelines& pipelines, ClothState& state, const Step& step);

}  // namespace drape
