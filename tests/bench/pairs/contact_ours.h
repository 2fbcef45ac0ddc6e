// Our time of contact, asked as the libraries are.
#pragma once

#include <cmath>
#include <memory>

#include "collision_core/narrow_phase/contact/time_of_contact.h"
#include "tests/bench/pairs/contact_method.h"

namespace collision::bench {

struct ContactShapes {
  std::shared_ptr<const shape::Shape> a, b;  ///< Null: a ball.
};

/// Null for a ball.
std::shared_ptr<const shape::Shape> ShapeOf(const MovingBody& body);

/// Both bodies, given by exact states: the motion between states is the predicted one.
narrow_phase::TimeOfContactResult OurContact(const ContactCase& of, const ContactShapes& shapes,
                                             const narrow_phase::ContactTolerance& tolerance);

/// Over the tolerance, on meshes and on convex solids; and deciding exactly in each frame.
ContactMethods OurContactCurves();
ContactMethods SteppingMethods();

/// What a library's time may be off to count as right, of the step; it is asked for a tenth.
inline constexpr double kContactRight = 1e-3;
inline bool IsRight(const std::optional<double>& found, const std::optional<double>& begin,
                    double step) {
  if (!begin || !found) return begin.has_value() == found.has_value();
  return std::abs(*found - *begin) <= kContactRight * step;
}

}  // namespace collision::bench
