// How any value of key frames goes from key to key: those of bodies (world/motion.h) and of cameras.
#pragma once

#include <vector>

#include "drape/scene.h"

namespace drape {

/// Returns what one of the values of keys (MotionKey, CameraKey) is at `time`, s, as key_at (world/motion.h) says;
/// zeros without keys.
template <class Key>
Vec3 value_at(const std::vector<Key>& keys, Vec3 Key::*value, double time);

}  // namespace drape
