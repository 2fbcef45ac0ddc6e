// Neighbours while a scene is drawn.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <vector>

namespace collision::baselines {

/// A cubic region about the origin, in cells not smaller than `cell`: two agents that are nearer to
/// each other than that are in the same cell or in neighbouring ones.
class Cells {
 public:
  Cells(double half, double cell)
      : half_(half), count_(std::max(1, static_cast<int>(2 * half / cell))) {
    first_.assign(static_cast<std::size_t>(count_) * count_ * count_, -1);
  }

  void Add(const Eigen::Vector3d& p) {
    int& first = first_[At(Index(p.x()), Index(p.y()), Index(p.z()))];
    next_.push_back(first);
    first = static_cast<int>(next_.size()) - 1;
  }

  template <typename Predicate>
  bool AnyNear(const Eigen::Vector3d& p, Predicate predicate) const {
    const std::array<int, 3> index = {Index(p.x()), Index(p.y()), Index(p.z())};
    for (int x = Lower(index[0]); x <= Upper(index[0]); ++x) {
      for (int y = Lower(index[1]); y <= Upper(index[1]); ++y) {
        for (int z = Lower(index[2]); z <= Upper(index[2]); ++z) {
          for (int at = first_[At(x, y, z)]; at >= 0; at = next_[at]) {
            if (predicate(at)) return true;
          }
        }
      }
    }
    return false;
  }

 private:
  int Index(double x) const {
    return std::clamp(static_cast<int>((x + half_) / (2 * half_) * count_), 0, count_ - 1);
  }
  int Lower(int i) const { return std::max(0, i - 1); }
  int Upper(int i) const { return std::min(count_ - 1, i + 1); }
  std::size_t At(int x, int y, int z) const {
    return (static_cast<std::size_t>(x) * count_ + y) * count_ + z;
  }

  double half_;
  int count_;
  std::vector<int> first_;
  std::vector<int> next_;
};

}  // namespace collision::baselines
