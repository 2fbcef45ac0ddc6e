// What the narrow phase may spend, counted so that the same inputs stop at the same place everywhere.
#pragma once

#include <cstdint>

namespace collision {

/// Units of work. A pair of spheres is the unit; the others cost about as many as they take time.
inline constexpr std::uint64_t kTrianglePairUnits = 10;
inline constexpr std::uint64_t kBoxPairUnits = 1;    ///< The boxes of two triangles.
inline constexpr std::uint64_t kCrossingUnits = 4;   ///< Whether two triangles cross.
inline constexpr std::uint64_t kWindingUnits = 100;  ///< One winding number.
inline constexpr std::uint64_t kPoseUnits = 50;      ///< Posing two bodies at an instant.

/// Everything that takes a budget looks at it before each step, and overruns it by less than this: a
/// step costs 243 units at most (all triangles of two blocks measured, separation_search.cc), and
/// something is said of one instant in any case: a pose, and a pair of balls.
inline constexpr std::uint64_t kBatchUnits = 243 + kPoseUnits + 1;

/// A budget. What has begun is finished: by less than kBatchUnits more than allowed may be spent.
class Work {
 public:
  explicit Work(std::uint64_t allowed) : allowed_(allowed) {}

  void Spend(std::uint64_t units) { spent_ += units; }
  std::uint64_t spent() const { return spent_; }
  std::uint64_t left() const { return spent_ < allowed_ ? allowed_ - spent_ : 0; }
  bool exhausted() const { return spent_ >= allowed_; }

 private:
  friend class WorkShare;
  std::uint64_t allowed_;
  std::uint64_t spent_ = 0;
};

/// While it lives only a share of what is left may be spent: so that what comes first leaves
/// something for what comes after.
class WorkShare {
 public:
  WorkShare(double share, Work* work) : work_(*work), allowed_(work->allowed_) {
    work_.allowed_ =
        work_.spent_ + static_cast<std::uint64_t>(share * static_cast<double>(work_.left()));
  }
  ~WorkShare() { work_.allowed_ = allowed_; }
  WorkShare(const WorkShare&) = delete;
  WorkShare& operator=(const WorkShare&) = delete;

 private:
  Work& work_;
  const std::uint64_t allowed_;
};

}  // namespace collision
