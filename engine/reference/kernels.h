// The shaders' own functions compiled as C++, so that the projection, the contact and the wind have one source.
#pragma once

#include "shared/closed_loop_types.h"
#include "shared/collider_types.h"
#include "shared/line_types.h"
#include "shared/nested_types.h"
#include "shared/residual_types.h"
#include "shared/self_contact_types.h"
#include "shared/simulation_types.h"
#include "shared/statistics_types.h"
#include "shared/tether_types.h"

namespace drape::glsl {

#include "include/bdf2.h"
#include "include/bend.h"
#include "include/bent_line.h"
#include "include/box_edges.h"
#include "include/colliders.h"
#include "include/contact_law.h"
#include "include/cut.h"
#include "include/cyclic.h"
#include "include/cyclic_bent.h"
#include "include/difference.h"
#include "include/end_velocity.h"
#include "include/explicit.h"
#include "include/line.h"
#include "include/nested.h"
#include "include/pin.h"
#include "include/residual.h"
#include "include/self_apart.h"
#include "include/self_contact.h"
#include "include/self_impulse.h"
#include "include/self_ring.h"
#include "include/spring.h"
#include "include/statistics.h"
#include "include/tether.h"
#include "include/triangles.h"
#include "include/vector.h"
#include "include/verlet.h"
#include "include/wind.h"

}  // namespace drape::glsl
