// The rows of the scene format that are about what a scene is told while it is simulated.
#pragma once

#include "scene/shared_rows.h"
#include "world/frame_limit.h"

namespace drape::rows {

inline const Named<SixNumbers> six_numbers{"six_numbers", "x, y, z, and about the same axes three more; or 0 of these.",
                                           three_or_six_numbers()};

/// A list of what each pin, hand and so on is told.
template <class T>
Value<std::vector<T>> told(const Value<T>& each) {
    return without_default(list(each, "an array with an entry for each", 0, 1'000'000));
}

inline const Object<FrameActions> frame_actions{
    "frame_actions",
    "What is told for the step to a frame, as for a step of an ensemble (docs/library.md): what is absent stays as it "
    "was.",
    {
        {"frame", &FrameActions::frame, integer(1, scene_frame_limit),
         "The frame that the step ends with, from 1. Must be after that of the entry before.", "a frame from 1 on"},
        {"wind", &FrameActions::wind, optional<Vec3>(vec3), "m/s, without gusts; wind.keys are over then."},
        {"gravity", &FrameActions::gravity, optional<Vec3>(vec3), "m/s^2; gravity_keys are over then."},
        {"pins", &FrameActions::pins, told<SixNumbers>(six_numbers),
         "Where all pins of all cloths are at the frame, m and degrees from where they start; straight on the way."},
        {"colliders", &FrameActions::colliders, told<SixNumbers>(six_numbers),
         "The same of all colliders: planes, spheres, boxes, ellipsoids, capsules and meshes, in this order."},
        {"holds", &FrameActions::holds, flags(), "Which pins hold during the step."},
        {"loads", &FrameActions::loads, told<Vec3>(vec3),
         "N, of the loads of all cloths, in order, during the step; of one that presses Pa, 0, 0."},
        {"hands", &FrameActions::hands, told<SixNumbers>(six_numbers),
         "Where the hands are at the frame, m and degrees, from the origin."},
        {"grasps", &FrameActions::grasps, told<Grasp>(grasp()),
         "What each hand holds during the step: column and row, or first column and row, last column and row; -1: "
         "nothing."},
        {"body_forces", &FrameActions::body_forces, told<SixNumbers>(six_numbers),
         "N and, about the centre of mass, N m on colliders with a mass, from this step on."},
        {"body_impulses", &FrameActions::body_impulses, told<SixNumbers>(six_numbers),
         "N s and N m s on them at the step's start, once."},
        {"body_velocities", &FrameActions::body_velocities, told<SixNumbers>(six_numbers),
         "m/s and rad/s that they have at the step's start, before impulses."},
        {"body_sets", &FrameActions::body_sets, flags(), "Which of them get their body_velocities. Absent: all."},
    }};

inline const Object<SceneActions> actions{
    "actions",
    "What the scene is told on the way: a run of an ensemble that was recorded, or one that is written by hand. It has "
    "the bits of an ensemble that is told the same.",
    {
        {"controls", &SceneActions::controls, controls(),
         "What may be told, of wind, pins, colliders, holds, gravity, loads and bodies."},
        {"hands", without_default(list(text(), hand_list, 0, most_hands)).text, read_hands,
         "Hands, which hold nothing at first: the name of the cloth whose particles each can take."},
        {"steps", &SceneActions::steps,
         without_default(list<FrameActions>(frame_actions, "an array of frames' actions", 0, 1'000'000)),
         "What is told, by frame."},
    },
    check_steps};

}  // namespace drape::rows
