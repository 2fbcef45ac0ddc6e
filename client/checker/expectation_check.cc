#include <set>

#include "client/checker/check.h"

namespace collision::checker {
namespace {

class ExpectationCheck {
 public:
  ExpectationCheck(const Evidence& evidence, const v1::SceneExpectation& expectation)
      : evidence_(evidence), expectation_(expectation) {}

  Violations Run() {
    for (const v1::ExpectedContact& contact : expectation_.contacts()) {
      if (WithinRun(contact.end_s())) CheckContact(contact);
    }
    if (expectation_.no_other_contact()) CheckOthers();
    for (const v1::EarliestExpectation& earliest : expectation_.earliest()) {
      if (WithinRun(earliest.from_s())) CheckEarliest(earliest);
    }
    return std::move(violations_);
  }

 private:
  long double Nanoseconds(double seconds) const {
    return evidence_.facts().start_ns + seconds * 1e9L;
  }

  // The run may be shorter than the scene, on request.
  bool WithinRun(double seconds) const {
    return Nanoseconds(seconds) < static_cast<long double>(evidence_.facts().end_ns);
  }

  // The bracket reaches into seconds ± tolerance.
  bool Meets(const v1::TimeBracket& bracket, double seconds, double tolerance) const {
    return bracket.earliest_ns() <= Nanoseconds(seconds + tolerance) &&
           bracket.latest_ns() >= Nanoseconds(seconds - tolerance);
  }

  bool IsPair(const EventHistory& history, const v1::ExpectedContact& expected) const {
    const std::string& a = evidence_.motions()[history.a].agent;
    const std::string& b = evidence_.motions()[history.b].agent;
    return (a == expected.a() && b == expected.b()) || (a == expected.b() && b == expected.a());
  }

  void CheckContact(const v1::ExpectedContact& expected) {
    for (const EventHistory& history : evidence_.histories()) {
      const v1::CollisionEvent& event = history.last();
      if (!IsPair(history, expected) || !IsConfirmed(event)) continue;
      if (!Meets(event.begin(), expected.begin_s(), expected.tolerance_s())) continue;
      if (!Meets(event.end(), expected.end_s(), expected.tolerance_s())) continue;
      matched_.insert(&history);
      CheckWidth("begin", event.begin(), expectation_.begin_width_max_s(), expected);
      CheckWidth("end", event.end(), expectation_.end_width_max_s(), expected);
      return;
    }
    violations_.push_back(Name(expected) + ": no confirmed event brackets it");
  }

  void CheckWidth(const char* which, const v1::TimeBracket& bracket, double width_max,
                  const v1::ExpectedContact& expected) {
    const double width =
        (static_cast<double>(bracket.latest_ns()) - static_cast<double>(bracket.earliest_ns())) *
        1e-9;
    if (width_max <= 0 || width < width_max) return;
    violations_.push_back(Name(expected) + ": the " + which + " bracket is " +
                          std::to_string(width) + " s wide, expected less than " +
                          std::to_string(width_max) + " s");
  }

  std::string Name(const v1::ExpectedContact& expected) const {
    return expected.a() + " × " + expected.b() + ", expected contact " +
           evidence_.Time(Nanoseconds(expected.begin_s())) + " to " +
           evidence_.Time(Nanoseconds(expected.end_s()));
  }

  void CheckOthers() {
    for (const EventHistory& history : evidence_.histories()) {
      if (!history.confirmed || matched_.contains(&history)) continue;
      violations_.push_back(evidence_.PairName(history.a, history.b) +
                            ": confirmed, but the scene expects no such contact; begin from " +
                            evidence_.Time(history.last().begin().earliest_ns()));
    }
  }

  // Times published before `at_most_s`; later ones are about other contacts.
  void CheckEarliest(const v1::EarliestExpectation& expected) {
    std::size_t samples = 0;
    for (const v1::EarliestIntersection& sample : evidence_.observations().earliest) {
      const auto now = static_cast<long double>(sample.now_ns());
      if (!sample.found() || now < Nanoseconds(expected.from_s()) ||
          now >= Nanoseconds(expected.at_most_s())) {
        continue;
      }
      ++samples;
      const auto earliest = static_cast<long double>(sample.earliest_ns());
      if (earliest >= Nanoseconds(expected.at_least_s()) &&
          earliest <= Nanoseconds(expected.at_most_s())) {
        continue;
      }
      violations_.push_back("at " + evidence_.Time(now) + " the earliest intersection was " +
                            evidence_.Time(earliest) + ", expected within [" +
                            evidence_.Time(Nanoseconds(expected.at_least_s())) + ", " +
                            evidence_.Time(Nanoseconds(expected.at_most_s())) + "]");
      return;
    }
    if (samples == 0) {
      violations_.push_back("no earliest intersection was published from " +
                            evidence_.Time(Nanoseconds(expected.from_s())) + " on");
    }
  }

  const Evidence& evidence_;
  const v1::SceneExpectation& expectation_;
  std::set<const EventHistory*> matched_;
  Violations violations_;
};

}  // namespace

Violations CheckExpectation(const Evidence& evidence, const v1::SceneExpectation& expectation) {
  return ExpectationCheck(evidence, expectation).Run();
}

Violations Check(const Evidence& evidence, const v1::SceneExpectation& expectation) {
  Violations all;
  for (const Violations& some :
       {CheckEvents(evidence), CheckGeometry(evidence), CheckLevels(evidence),
        CheckClearances(evidence), CheckEarliest(evidence),
        CheckExpectation(evidence, expectation)}) {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

}  // namespace collision::checker
