// Who is so much more violent than another that it would have it asked about everybody, over and
// over.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace collision {

/// A scene's agents by classes of their acceleration bounds, each class 16 times the one before.
/// Beside an agent whoever stands two classes above is restless: surely with 256 times its bound,
/// and never with 16 times or less. Beside one that declares none nobody is.
class Restlessness {
 public:
  static constexpr int kClasses = 33;

  /// What the agent declares from now on.
  void Set(std::uint32_t agent, double acceleration_max) { Put(agent, ClassOf(acceleration_max)); }
  /// It is not there any more.
  void Remove(std::uint32_t agent) { Put(agent, 0); }

  /// Agents of equal class are alike; < kClasses. 0: it declares none, or is not there.
  int of(std::uint32_t agent) const { return classes_[agent]; }

  bool IsRestless(std::uint32_t partner, std::uint32_t beside) const {
    return Stands(classes_[partner], classes_[beside]);
  }

  /// How many are restless beside it.
  std::uint32_t CountBeside(std::uint32_t beside) const {
    std::uint32_t count = 0;
    for (int k = kClasses - 1; Stands(k, classes_[beside]); --k) count += counts_[k];
    return count;
  }

 private:
  static bool Stands(int high, int low) { return low > 0 && high >= low + 2; }

  static int ClassOf(double acceleration_max) {
    constexpr int kLeast = -64, kGreatest = 63, kExponents = 4;
    if (!(acceleration_max > 0)) return 0;
    return 1 + (std::clamp(std::ilogb(acceleration_max), kLeast, kGreatest) - kLeast) / kExponents;
  }

  void Put(std::uint32_t agent, int of_class) {
    if (classes_.size() <= agent) classes_.resize(agent + 1, 0);
    if (classes_[agent] > 0) --counts_[classes_[agent]];
    if (of_class > 0) ++counts_[of_class];
    classes_[agent] = static_cast<std::uint8_t>(of_class);
  }

  std::array<std::uint32_t, kClasses> counts_{};
  std::vector<std::uint8_t> classes_;  // by agent
};

}  // namespace collision
