// How any value of key frames goes from key to key: those of bodies (world/motion.h) and of cameras.
#pragma once

#include <vector>

#include "drape/scene.h"

namespace drape {

/// Returns what one of the values of keys (MotionKey, CameraKey) is at `time`, s, as key_at (world/motion.h) says;
/// zeros without keys. Its name is its own: {} for a vector would be a null member, too.
template <class Key>
Vec3 keyed_value(const std::vector<Key>& keys, Vec3 Key::*value, double time);

}  // namespace drape
