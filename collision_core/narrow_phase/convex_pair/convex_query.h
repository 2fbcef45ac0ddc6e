// Queries about two convex sets: goal, tolerances and units of work.
#pragma once

#include <cstdint>

namespace collision::narrow_phase {

/// Units of work for a step of a search: a pair of support points; in a growing polytope, more.
inline constexpr std::uint64_t kGjkStepUnits = 1;
inline constexpr std::uint64_t kEpaStepUnits = 4;
inline constexpr std::uint64_t kBoxAxesUnits = 4;  ///< The separating axis test of two boxes.

/// The goal of a query about two convex sets.
enum class ConvexGoal {
  kYesNo,     ///< Certainly apart, or certainly in contact, and nothing more.
  kDistance,  ///< The distance; if they overlap, only that they do.
  kDepth      ///< The distance, or how deep they overlap.
};

/// The goal of a query, and how narrow its bracket has to be. Both tolerances 0: as narrow as
/// doubles make it.
struct ConvexQuery {
  ConvexGoal goal = ConvexGoal::kDepth;
  double relative_tolerance = 0;  ///< Width of the bracket over its lower end, >= 0.
  double absolute_tolerance = 0;  ///< Width of the bracket [m], >= 0.
};

}  // namespace collision::narrow_phase
