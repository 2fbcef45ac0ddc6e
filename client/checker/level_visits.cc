#include "client/checker/level_visits.h"

#include <map>
#include <utility>

namespace collision::checker {
namespace {

// What is known of a pair up to an instant.
struct PairVisits {
  std::vector<const TrueContact*> wide;  // in order
  std::size_t passed = 0;                // of `wide`: the last that began before the crossing
  std::size_t visit = 0, long_visit = 0;
};

// Whether an instant before the crossing in which the two were beyond may have stayed unseen.
bool IsUncertain(const TrueContact& wide) { return !wide.blind.empty() || !wide.certain; }

}  // namespace

void NumberVisits(const std::vector<TrueContact>& wide, long double apart_min_ns,
                  std::vector<TrueContact>* crossings) {
  std::map<std::pair<std::size_t, std::size_t>, PairVisits> pairs;
  for (const TrueContact& span : wide) pairs[{span.a, span.b}].wide.push_back(&span);
  for (TrueContact& crossing : *crossings) {
    PairVisits& pair = pairs[{crossing.a, crossing.b}];
    while (pair.passed < pair.wide.size() &&
           pair.wide[pair.passed]->begin_ns <= crossing.begin_ns + kRootTolerance) {
      const TrueContact& next = *pair.wide[pair.passed];
      const bool first = pair.passed == 0;
      ++pair.visit;
      if (first || next.begin_ns - pair.wide[pair.passed - 1]->end_ns > apart_min_ns) {
        ++pair.long_visit;
      }
      ++pair.passed;
    }
    if (pair.passed > 0 && IsUncertain(*pair.wide[pair.passed - 1])) ++pair.visit;
    crossing.visit = pair.visit;
    crossing.long_visit = pair.long_visit;
  }
}

}  // namespace collision::checker
