// The queries of the core about each pair, and their times. They are intercepted at the linker: the
// core does not know of it, and no caller can be forgotten.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "collision_core/base/instant.h"

namespace collision::stress {

enum class Query {
  kJudged,  ///< EvaluateSegments(): a tracked pair over an interval of time.
  kAsked,   ///< EarliestIntersection() of a tracked pair from a time on.
  kMet      ///< The same up to some time: by the broad phase, for one agent and its partners.
};
inline constexpr int kQueries = 3;

/// One query. Equal ones have the same bits.
struct LoggedQuery {
  std::int64_t now = 0;   ///< The time of the step [ns].
  std::int64_t from = 0;  ///< Where the interval begins; for kJudged, where it ends [ns].
  double answer = 0;      ///< [s] after `base`; 0 for kMet, which searches no further than needed.
  std::int64_t base = 0;  ///< [ns]

  friend bool operator==(const LoggedQuery&, const LoggedQuery&) = default;
};

/// Records every query to the core in this thread, as long as it exists. The declared radius
/// identifies an agent: each has one of its own.
class QueryLog {
 public:
  /// The two radii, the lesser first.
  using Pair = std::pair<double, double>;
  using Queries = std::map<Pair, std::vector<LoggedQuery>>;

  QueryLog();
  ~QueryLog();
  QueryLog(const QueryLog&) = delete;
  QueryLog& operator=(const QueryLog&) = delete;

  void SetNow(Instant now) { now_ = now.nanoseconds(); }
  void Record(Query query, double radius, double other, LoggedQuery logged);

  const Queries& of(Query query) const { return of_[static_cast<int>(query)]; }

 private:
  std::int64_t now_ = 0;
  Queries of_[kQueries];
};

}  // namespace collision::stress
