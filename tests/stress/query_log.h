// What the core asks about each pair, and when: seen at the linker, so that the core knows nothing
// of it and no place that asks can be forgotten.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "collision_core/base/instant.h"

namespace collision::stress {

enum class Query {
  kJudged,  ///< EvaluateSegments(): what is known of a tracked pair, over an interval of time.
  kAsked,   ///< EarliestIntersection() from a time on: a tracked pair's, asked again.
  kMet      ///< The same up to some time: by the broad phase, of one agent and its partners.
};
inline constexpr int kQueries = 3;

/// One query as it was put. Equal ones are the same bits.
struct Asked {
  std::int64_t now = 0;   ///< Of the step [ns].
  std::int64_t from = 0;  ///< Where the answer begins; of kJudged where it ends [ns].
  double answer = 0;      ///< [s] after `base`; of kMet, which looks no farther than it must, 0.
  std::int64_t base = 0;  ///< [ns]

  friend bool operator==(const Asked&, const Asked&) = default;
};

/// While one of these is there it takes down every query to the core, in this thread. Agents are
/// known by the radii they declare: each has one of its own.
class QueryLog {
 public:
  /// The two radii, the lesser first.
  using Pair = std::pair<double, double>;
  using Queries = std::map<Pair, std::vector<Asked>>;

  QueryLog();
  ~QueryLog();
  QueryLog(const QueryLog&) = delete;
  QueryLog& operator=(const QueryLog&) = delete;

  void SetNow(Instant now) { now_ = now.nanoseconds(); }
  void Note(Query query, double radius, double other, Asked asked);

  const Queries& of(Query query) const { return of_[static_cast<int>(query)]; }

 private:
  std::int64_t now_ = 0;
  Queries of_[kQueries];
};

}  // namespace collision::stress
