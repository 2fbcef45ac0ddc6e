// On which side of a line or a plane a point lies, exactly.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace collision::numeric {

/// The sign (-1, 0, 1) of (b − a) × (c − a): 1 if a, b, c turn anticlockwise. Exact for coordinates
/// below 1e100; nullopt if the sign is unknown because products of coordinate differences
/// underflow; that takes a nonzero coordinate below about 1e-140.
std::optional<int> OrientationSign(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                                   const Eigen::Vector2d& c);

/// The sign of ((b − a) × (c − a)) · (p − a): 1 if p sees a, b, c anticlockwise. Exact as above;
/// nullopt takes a nonzero coordinate below about 1e-95.
std::optional<int> OrientationSign(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                   const Eigen::Vector3d& c, const Eigen::Vector3d& p);

/// Whether all three lie on one line, certified.
bool IsCertainlyCollinear(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                          const Eigen::Vector3d& c);

}  // namespace collision::numeric
