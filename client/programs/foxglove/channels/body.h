// The shape of an agent as what Foxglove draws.
#pragma once

#include <array>
#include <cstddef>

#include "client/programs/foxglove/messages/foxglove.pb.h"
#include "idl/shape_bytes.h"

namespace collision::client {

/// A shape with more of any is not drawn.
inline constexpr std::size_t kDrawnTrianglesMax = 200'000;
inline constexpr std::size_t kDrawnSolidsMax = 256;
inline constexpr std::size_t kDrawnHullPointsMax = 20'000;  ///< Of all hulls.

/// Adds a shape, in the body frame: its surface, and each solid as one of Foxglove's own forms, or
/// triangulated (solid_surface.h) where there is none. Returns whether it is drawn; then something
/// was added.
bool AddShape(const ShapeContent& shape, const foxglove::Color& color,
              foxglove::SceneEntity* entity);

/// Adds a ball about a point.
void AddBall(const std::array<double, 3>& center, double radius, const foxglove::Color& color,
             foxglove::SceneEntity* entity);

/// Adds the surface of { x : normal . x <= offset } about its point next to the origin, as a plate
/// of kPlateSide that lies inside. `normal` has length 1.
void AddHalfSpace(const std::array<double, 3>& normal, double offset, const foxglove::Color& color,
                  foxglove::SceneEntity* entity);

/// A half-space has no end; so much of it is drawn [m].
inline constexpr double kPlateSide = 2000;

/// The rotation that turns +x (`axis` 0), +y or +z into `direction`, whose length is 1.
foxglove::Quaternion TurnOf(int axis, const std::array<double, 3>& direction);

}  // namespace collision::client
