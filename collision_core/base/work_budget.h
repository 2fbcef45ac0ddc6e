// What the narrow phase may spend, counted so that the same inputs stop at the same place
// everywhere.
//
// The unit is a pair of spheres, or a wide step over up to eight pairs. Two blocks of triangles
// cost 3, a pair of triangles 10, a pose 50, a winding number 100: in proportion to the time that
// they take, some 18 units a microsecond on the machine on which they were measured. The budget of
// a pair's evaluation is shared out in advance (WorkShare), so that what comes first leaves
// something for what comes after. It is checked before each step and overrun by less than
// kBatchUnits, for every query and all bodies (budget_test). When it is exhausted, the bracket
// stays as wide as it is, and the event says that the budget limited it.
#pragma once

#include <cstdint>

namespace collision {

/// What one piece of work costs; a pair of spheres is the unit.
inline constexpr std::uint64_t kTrianglePairUnits = 10;
inline constexpr std::uint64_t kBoxPairUnits = 1;    ///< The boxes of two triangles.
inline constexpr std::uint64_t kCrossingUnits = 4;   ///< Whether two triangles cross.
inline constexpr std::uint64_t kWindingUnits = 100;  ///< One winding number.
inline constexpr std::uint64_t kPoseUnits = 50;      ///< Posing two bodies at an instant.
/// What a segment of time of two bodies costs beside its queries; counted where the budget bounds
/// the work (WhenExhausted::kLeaveUndecided).
inline constexpr std::uint64_t kSegmentUnits = 200;

/// A budget is overrun by less than this. A step costs at most 243 units (all triangles of two
/// blocks measured, separation_search.cc), and every query evaluates at least one instant, which
/// costs a pose and a pair of balls.
inline constexpr std::uint64_t kBatchUnits = 243 + kPoseUnits + 1;

/// What becomes of the intervals of time that are left when a budget for several is exhausted.
enum class WhenExhausted {
  kQueryOnce,      ///< Each gets one query, beyond the budget.
  kLeaveUndecided  ///< All of them are undecided, at no cost, so that the budget bounds the work.
};

/// Counts work against a limit. A step that has begun is finished, so the work spent exceeds the
/// limit by less than kBatchUnits.
class WorkBudget {
 public:
  explicit WorkBudget(std::uint64_t allowed, WhenExhausted then = WhenExhausted::kQueryOnce)
      : allowed_(allowed), then_(then) {}

  void Spend(std::uint64_t units) { spent_ += units; }
  std::uint64_t spent() const { return spent_; }
  std::uint64_t left() const { return spent_ < allowed_ ? allowed_ - spent_ : 0; }
  bool exhausted() const { return spent_ >= allowed_; }
  WhenExhausted when_exhausted() const { return then_; }

 private:
  friend class WorkShare;
  std::uint64_t allowed_;
  std::uint64_t spent_ = 0;
  WhenExhausted then_;
};

/// While this object exists, only `share` (0 to 1) of the work that is left may be spent, so that
/// one search leaves something for the next.
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
