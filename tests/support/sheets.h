// Scenes that tests build in code: one sheet of given size, no camera.
#pragma once

#include "reference/model_scenes.h"

namespace drape::test {

using model_scenes::pin_box;
using model_scenes::pin_top;
using model_scenes::sheet;

}  // namespace drape::test
