// Least width of a hull: the twin of shipcollision_fmu/collision/geometry/thickness.py.
#pragma once

#include "../../ship/hull/solid.hpp"

namespace shipcollision {

// Least distance [m] of two parallel planes that hold a convex part between them, one of them along a face.
double least_width(const HullMesh& hull);

}  // namespace shipcollision
