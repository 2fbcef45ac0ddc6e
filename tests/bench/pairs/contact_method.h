// Methods that answer when two moving bodies begin to touch.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tests/bench/pairs/contact_case.h"

namespace collision::bench {

/// The answer to one case [s]; peers answer one number.
struct ContactReply {
  enum class Verdict { kFree, kContact, kUndecided };
  Verdict verdict = Verdict::kFree;
  double lower = 0, upper = 0;  ///< Of the begin.

  /// For a method that answers one number: when contact begins, if it does.
  std::optional<double> begin() const {
    return verdict == Verdict::kContact ? std::optional(lower) : std::nullopt;
  }
};

inline ContactReply Plainly(const std::optional<double>& begin) {
  if (!begin) return {};
  return {ContactReply::Verdict::kContact, *begin, *begin};
}

using ContactQuery = std::function<ContactReply()>;

struct ContactMethod {
  std::string name, setting = {};
  Origin origin = Origin::kLibrary;
  bool certified = false;
  bool naive = false;
  bool may_not_end = false;  ///< Asked in a process of its own.
  std::string limited_by = {};
  /// Builds what it needs for a case; null where it does not take such bodies.
  std::function<ContactQuery(const ContactCase&)> make = nullptr;
};
using ContactMethods = std::vector<ContactMethod>;

}  // namespace collision::bench
