#include "tests/support/suite/case.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace collision::suite {

bool Outcome::Expect(bool holds, const std::string& what) {
  ++checks_;
  if (!holds && failures_++ == 0) first_failure_ = what;
  return holds;
}

double& Outcome::Slot(const std::string& name, double initial) {
  const auto found = std::find_if(numbers_.begin(), numbers_.end(),
                                  [&](const auto& number) { return number.first == name; });
  if (found != numbers_.end()) return found->second;
  numbers_.emplace_back(name, initial);
  return numbers_.back().second;
}

void Outcome::Set(const std::string& name, double value) {
  Expect(std::isfinite(value), name + " is not finite");
  Slot(name, value) = value;
}

void Outcome::Greatest(const std::string& name, double value) {
  if (!Expect(std::isfinite(value), name + " is not finite")) return;
  double& slot = Slot(name, value);
  slot = std::max(slot, value);
}

void Outcome::Add(const std::string& name, double value) { Slot(name, 0) += value; }

double Outcome::Get(const std::string& name) const {
  for (const auto& [known, value] : numbers_) {
    if (known == name) return value;
  }
  return 0;
}

void Outcome::SetList(const std::string& name, const std::vector<double>& values) {
  const bool finite =
      std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  if (Expect(finite, name + " is not finite")) lists_.emplace_back(name, values);
}

std::string Outcome::Measured() const {
  std::string text = said_;
  if (text.empty()) {
    for (const auto& [name, value] : numbers_) {
      text += (text.empty() ? "" : ", ") + name + " " + Show(value);
    }
  }
  if (checks_ == 0) return "nothing was checked";
  if (failures_ == 0) return text;
  return "BROKEN (" + Show(static_cast<double>(failures_)) + " of " +
         Show(static_cast<double>(checks_)) + " checks): " + first_failure_ +
         (text.empty() ? "" : "; ") + text;
}

std::string Show(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

}  // namespace collision::suite
