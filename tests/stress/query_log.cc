#include "tests/stress/query_log.h"

#include <algorithm>

#include "collision_core/detection/pairs/interval_evaluation.h"
#include "collision_core/intersection/earliest_intersection.h"

// The linker takes __wrap_X for X wherever one source of the core calls another, and __real_X is
// then X itself. CMakeLists.txt beside this file names the functions as the C++ ABI of g++ and
// clang++ does; a function of another signature would not be wrapped, which `violent-agent`
// notices.

namespace collision::stress {
namespace {

thread_local QueryLog* log = nullptr;

}  // namespace

using Bound = motion::SpaceTimeBound;

intersection::IntersectionTime RealAsk(const Bound& a, const Bound& b,
                                       Instant from) asm("__real_" COLLISION_ASK);
intersection::IntersectionTime RealMeet(const Bound& a, const Bound& b, Instant from, Instant until,
                                        double margin) asm("__real_" COLLISION_MEET);
detection::SegmentCount RealJudge(
    const detection::History& a, const detection::History& b, Instant until, WorkBudget* work,
    detection::ContactTracker* tracker) asm("__real_" COLLISION_JUDGE);

intersection::IntersectionTime WrappedAsk(const Bound& a, const Bound& b,
                                          Instant from) asm("__wrap_" COLLISION_ASK);
intersection::IntersectionTime WrappedMeet(const Bound& a, const Bound& b, Instant from,
                                           Instant until,
                                           double margin) asm("__wrap_" COLLISION_MEET);
detection::SegmentCount WrappedJudge(
    const detection::History& a, const detection::History& b, Instant until, WorkBudget* work,
    detection::ContactTracker* tracker) asm("__wrap_" COLLISION_JUDGE);

intersection::IntersectionTime WrappedAsk(const Bound& a, const Bound& b, Instant from) {
  const intersection::IntersectionTime time = RealAsk(a, b, from);
  if (log != nullptr) {
    log->Record(
        Query::kAsked, a.limits.radius, b.limits.radius,
        {.from = from.nanoseconds(), .answer = time.seconds, .base = time.base.nanoseconds()});
  }
  return time;
}

intersection::IntersectionTime WrappedMeet(const Bound& a, const Bound& b, Instant from,
                                           Instant until, double margin) {
  if (log != nullptr) {
    log->Record(Query::kMet, a.limits.radius, b.limits.radius, {.from = from.nanoseconds()});
  }
  return RealMeet(a, b, from, until, margin);
}

detection::SegmentCount WrappedJudge(const detection::History& a, const detection::History& b,
                                     Instant until, WorkBudget* work,
                                     detection::ContactTracker* tracker) {
  if (log != nullptr) {
    log->Record(Query::kJudged, a.newest().bound.limits.radius, b.newest().bound.limits.radius,
                {.from = until.nanoseconds()});
  }
  return RealJudge(a, b, until, work, tracker);
}

QueryLog::QueryLog() { log = this; }

QueryLog::~QueryLog() { log = nullptr; }

void QueryLog::Record(Query query, double radius, double other, LoggedQuery logged) {
  const auto [lesser, greater] = std::minmax(radius, other);
  logged.now = now_;
  of_[static_cast<int>(query)][{lesser, greater}].push_back(logged);
}

}  // namespace collision::stress
