// Who is so much more violent than another that it would have it asked about everybody, over and
// over.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace collision::detection {

/// A scene's agents by classes of their acceleration bounds, each class 8 times the one before.
/// Beside an agent whoever stands two classes above is restless: surely with 64 times its bound,
/// and never with 8 times or less. Beside one that declares none everybody is who declares any;
/// where more than kDeclareNoneMax do, nobody is: each would be asked about all the others that
/// hardly move, to the end of time. Else this is a matter of the two alone.
class Restlessness {
 public:
  static constexpr int kClasses = 44;
  /// The group of all that are not restless beside an agent.
  static constexpr int kCalm = 0;
  /// A class that nobody is ever of.
  static constexpr int kNobody = kClasses;
  static constexpr std::uint32_t kDeclareNoneMax = 256;

  /// What the agent declares from now on.
  void Set(std::uint32_t agent, double acceleration_max) { Put(agent, ClassOf(acceleration_max)); }
  /// It is not there any more.
  void Remove(std::uint32_t agent) { Put(agent, kNobody); }

  /// Agents of equal class are alike. 0: it declares none; kNobody: it is not there.
  int of(std::uint32_t agent) const { return classes_[agent]; }

  /// Whether anybody may be restless beside it.
  bool Divides(std::uint32_t agent) const {
    return classes_[agent] > 0 || counts_[0] <= kDeclareNoneMax;
  }
  /// The partner's class if it is restless beside the agent; otherwise kCalm.
  int GroupOf(std::uint32_t partner, std::uint32_t beside) const {
    const int of_class = classes_[partner];
    return Stands(of_class, beside) ? of_class : kCalm;
  }

  /// How many are of a class.
  std::uint32_t Count(int of_class) const { return counts_[of_class]; }

  /// Appends the classes of all that are restless beside the agent, in ascending order.
  void RestlessBeside(std::uint32_t agent, std::vector<int>* classes) const {
    for (int k = 1; k < kClasses; ++k) {
      if (counts_[k] > 0 && Stands(k, agent)) classes->push_back(k);
    }
  }

 private:
  bool Stands(int of_class, std::uint32_t beside) const {
    const int least = classes_[beside] + (classes_[beside] > 0 ? 2 : 1);
    return of_class != kNobody && of_class >= least && Divides(beside);
  }

  static int ClassOf(double acceleration_max) {
    constexpr int kLeast = -64, kGreatest = 63, kExponents = 3;
    if (!(acceleration_max > 0)) return 0;
    return 1 + (std::clamp(std::ilogb(acceleration_max), kLeast, kGreatest) - kLeast) / kExponents;
  }

  void Put(std::uint32_t agent, int of_class) {
    if (classes_.size() <= agent) classes_.resize(agent + 1, kNobody);
    if (classes_[agent] != kNobody) --counts_[classes_[agent]];
    if (of_class != kNobody) ++counts_[of_class];
    classes_[agent] = static_cast<std::uint8_t>(of_class);
  }

  std::array<std::uint32_t, kClasses + 1> counts_{};
  std::vector<std::uint8_t> classes_;  // by agent
};

}  // namespace collision::detection
