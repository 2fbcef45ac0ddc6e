// Triangles of convex solids for which a viewer has no form of its own.
#pragma once

#include "idl/shape_bytes.h"

namespace collision::client {

/// A surface inscribed in a solid, in the solid's frame, rounding included: a triangulated unit
/// sphere of which each vertex d is moved to the solid's farthest point in direction d. Every
/// vertex lies on the solid's surface; where the solid has more corners than the sphere has
/// vertices, some are cut off. For eyes, not for proofs.
ShapeContent SolidSurface(const SolidContent& solid);

}  // namespace collision::client
