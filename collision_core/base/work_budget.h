// What the narrow phase may spend, counted so that the same inputs stop at the same place
// everywhere.
//
// A pair of spheres costs 1, or up to eight in a wide step; two blocks of triangles 3, a pair of
// triangles 10, a pose 50, a winding number 100: about as they take time, some 18 units a
// microsecond on the machine on which they were measured. The budget of a pair's evaluation is
// shared out in advance (WorkShare), so that what comes first leaves something for what comes
// after. It is checked before each step and overrun by less than kBatchUnits, whatever is asked of
// any bodies (budget_test). Where it ends the bracket stays as wide as it is then, and the event
// says that the budget limited it.
#pragma once

#include <cstdint>

namespace collision {

/// Units of work. A pair of spheres is the unit; the others cost about as many as they take time.
inline constexpr std::uint64_t kTrianglePairUnits = 10;
inline constexpr std::uint64_t kBoxPairUnits = 1;    ///< The boxes of two triangles.
inline constexpr std::uint64_t kCrossingUnits = 4;   ///< Whether two triangles cross.
inline constexpr std::uint64_t kWindingUnits = 100;  ///< One winding number.
inline constexpr std::uint64_t kPoseUnits = 50;      ///< Posing two bodies at an instant.

/// The most by which a budget is overrun, less one unit: a step costs 243 units at most (all
/// triangles of two blocks measured, separation_search.cc), and every query says something about
/// one instant: a pose, and a pair of balls.
inline constexpr std::uint64_t kBatchUnits = 243 + kPoseUnits + 1;

/// A budget. What has begun is finished: by less than kBatchUnits more than allowed may be spent.
class WorkBudget {
 public:
  explicit WorkBudget(std::uint64_t allowed) : allowed_(allowed) {}

  void Spend(std::uint64_t units) { spent_ += units; }
  std::uint64_t spent() const { return spent_; }
  std::uint64_t left() const { return spent_ < allowed_ ? allowed_ - spent_ : 0; }
  bool exhausted() const { return spent_ >= allowed_; }

 private:
  friend class WorkShare;
  std::uint64_t allowed_;
  std::uint64_t spent_ = 0;
};

/// While it lives, only a share of what is left may be spent, so that what comes first leaves
/// something for what comes after.
class WorkShare {
 public:
  WorkShare(double share, WorkBudget* work) : work_(*work), allowed_(work->allowed_) {
    work_.allowed_ =
        work_.spent_ + static_cast<std::uint64_t>(share * static_cast<double>(work_.left()));
  }
  ~WorkShare() { work_.allowed_ = allowed_; }
  WorkShare(const WorkShare&) = delete;
  WorkShare& operator=(const WorkShare&) = delete;

 private:
  WorkBudget& work_;
  const std::uint64_t allowed_;
};

}  // namespace collision
