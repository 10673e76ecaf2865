#pragma once

#include "shlight/transfer/sites.h"
#include "shlight/transfer/world_mesh.h"

namespace shlight {

// Sets where the rays of each site begin: at a distance from the surface that is small, but larger than the rounding of
// coordinates and of what tracers do with them, so that no ray meets the surface that it leaves.
//
// Along the normal is right almost everywhere, but where surfaces touch or meet in a sharp valley it is not enough: the
// foot of a box on a floor lies in the floor's plane, and of its rays that go down, rounding would let some through. So
// a site that another triangle touches moves to the side of that triangle on which its own surface lies.
void place_origins(const WorldMesh& world, int threads, Sites& sites);

}  // namespace shlight
