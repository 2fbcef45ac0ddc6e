// Two bodies at a pose, what is asked of them, and the methods that answer.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace collision::bench {

/// The caller's triangles, as plain numbers: the libraries have types of their own.
struct PlainMesh {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// B's body frame seen from A's, which is the world's: x_A = rotation x_B + offset. Rows first.
struct PlainPose {
  std::array<std::array<double, 3>, 3> rotation;
  std::array<double, 3> offset;
};

enum class Task {
  kDecision,  ///< Yes (1), no (0), or not decided: [0, 1].
  kDistance,  ///< [m]; in the contest to 1e-6 of it.
  kBracket    ///< The distance, to 1 % of the diameter.
};
const char* Name(Task task);

/// Libraries answer one number: both ends are the same.
struct Reply {
  double lower = 0;
  double upper = 0;

  double middle() const { return 0.5 * (lower + upper); }
};
inline Reply Plain(double value) { return {value, value}; }

/// Where a method comes from, and so where its times count.
enum class Origin {
  kOurs,     ///< What the service uses.
  kOther,    ///< Another method of ours: printed, in no figure.
  kLibrary,  ///< The best one counts in the figures.
  kBaseline  ///< What the paper did: printed, in no figure.
};

/// A method at one of its settings: one row of the contest, or one point of a curve of error
/// against time.
struct PairMethod {
  std::string name;
  std::string setting = {};  ///< As text, with its unit; empty: it has none.
  Task task = Task::kDistance;
  Origin origin = Origin::kLibrary;
  bool certified = false;       ///< Both ends of its answers are proven.
  std::string limited_by = {};  ///< What keeps its answers from being better.
  std::function<Reply(const PlainPose&)> ask = nullptr;  ///< Owns what it needs.
  /// For methods that share one budget among all poses: instead of `ask`.
  std::function<std::vector<Reply>(const std::vector<PlainPose>&)> ask_all = nullptr;
};
using PairMethods = std::vector<PairMethod>;

template <typename Item>
void Append(std::vector<Item> some, std::vector<Item>* all) {
  for (Item& item : some) all->push_back(std::move(item));
}

/// "margin 1e-06 m"; `what` and `unit` may be empty.
std::string SettingText(const char* what, double value, const char* unit);

}  // namespace collision::bench
