// Words about the end of credentials, in time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace collision::credentials {

/// Says that credentials end: 30 days, 7 days, 1 day and 1 hour ahead, and when they have ended,
/// again every minute. Depends on nothing but the calls.
class EndWatch {
 public:
  /// `what`: the file that ends first; `end` [s since 1970].
  EndWatch(std::string what, std::int64_t end) : what_(std::move(what)), end_(end) {}

  /// A sentence if there is something to say at `now` [s since 1970] that has not been said.
  std::optional<std::string> Look(std::int64_t now);

  bool ended(std::int64_t now) const { return now > end_; }

 private:
  std::string what_;
  std::int64_t end_;
  std::optional<std::int64_t> told_ahead_;  ///< Of kAhead, the least that was told.
  std::optional<std::int64_t> told_ended_;  ///< When.
};

}  // namespace collision::credentials
