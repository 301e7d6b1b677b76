// The reader of each section of a scene. Each reports what does not fit and leaves the defaults of what is
// absent; the sections know nothing of each other.
#pragma once

#include "scene/scene_node.h"

namespace drape {

void read_time(SceneNode node, TimeSettings& time);
void read_wind(SceneNode node, Wind& wind);
void read_solver(SceneNode node, SolverSettings& solver);
void read_camera(SceneNode node, Camera& camera);
void read_lights(SceneNode node, std::vector<DirectionalLight>& lights);
void read_image(SceneNode node, ImageSettings& image);
void read_oracles(SceneNode node, std::vector<Oracle>& oracles);
void read_path(SceneNode node, MotionPath& path);

void read_colliders(SceneNode node, Colliders& colliders);

void read_cutters(SceneNode node, std::vector<Cutter>& cutters);

void read_cloths(SceneNode node, std::vector<Cloth>& cloths);

}  // namespace drape
