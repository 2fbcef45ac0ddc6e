// When two bodies begin to touch, where the answer is closed: cases, methods and what they say.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/bench/narrow_contact_case.h"
#include "tests/bench/narrow_query.h"
#include "tests/bench/precision_pose.h"

namespace collision::bench {

/// Cases of one kind, in steps of 1 s. Their closed answers are rounded from long doubles, to
/// within `slack` [s].
struct ContactFamily {
  Motion motion;
  std::string name;
  std::vector<ContactCase> cases;
  std::vector<double> slack;
};

/// Seeded, `count` cases each: boxes, balls, balls at 10 km/s and plates that move; a bar that
/// turns into a ball, a cube that turns its edge into a plate; and grazing by 1e-3 to 1e-12 of the
/// size, on both sides: balls that pass, a cube that turns its edge past a ball.
std::vector<ContactFamily> ContactFamilies(std::size_t count);

/// What is said of one case [s]; peers say one number.
struct ContactReply {
  enum class Verdict { kFree, kContact, kUndecided };
  Verdict verdict = Verdict::kFree;
  double lower = 0, upper = 0;  ///< Of the begin.
};

struct ContactMethod {
  std::string name, setting;
  Who who = Who::kLibrary;
  bool certified = false;
  bool naive = false;
  bool may_not_end = false;  ///< Asked in a process of its own.
  std::string limited_by;
  /// Builds what it needs; null where it does not take such bodies.
  std::function<std::function<ContactReply()>(const ContactCase&)> make;
};
using ContactMethods = std::vector<ContactMethod>;

ContactMethods OurContactMethods();
ContactMethods SteppingMethods();
ContactMethods FclContactMethods();
ContactMethods BulletContactMethods();

inline ContactReply Plainly(const std::optional<double>& begin) {
  if (!begin) return {};
  return {ContactReply::Verdict::kContact, *begin, *begin};
}

}  // namespace collision::bench
