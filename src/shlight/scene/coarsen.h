#pragma once

#include <cstddef>

#include "shlight/scene/scene.h"

namespace shlight {

// The scene with the same vertices, but only about so many triangles, of all instances, where it has more; meshes keep
// their shares of them, and at least 128 each or all they have. Vertices that lie close together are replaced by one of
// them, evenly all over the surface [1], so that what is known of vertices, light above all, is thinned out no more on
// flat surfaces than on others. For pictures of so few pixels that it is hardly seen.
//
// [1] Rossignac, Borrel 1993, Multi-Resolution 3D Approximations for Rendering Complex Scenes, Modeling in Computer
//     Graphics.
Scene coarsen(Scene scene, std::size_t triangles);

}  // namespace shlight
