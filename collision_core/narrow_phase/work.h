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

/// A budget. What has begun is finished, so that a little more than allowed may be spent.
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
