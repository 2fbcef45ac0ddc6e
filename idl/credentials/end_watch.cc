#include "idl/credentials/end_watch.h"

#include <algorithm>

#include "idl/credentials/validity.h"

namespace collision::credentials {
namespace {

constexpr std::int64_t kHour = 3600, kDay = 24 * kHour;

/// How long before the end it is said [s].
constexpr std::int64_t kAhead[] = {kHour, kDay, 7 * kDay, 30 * kDay};

/// What has ended is said again after so long [s].
constexpr std::int64_t kAgain = 60;

std::string LeftText(std::int64_t seconds) {
  if (seconds < 2 * kHour) return std::to_string(seconds / 60) + " min";
  if (seconds < 2 * kDay) return std::to_string(seconds / kHour) + " h";
  return std::to_string(seconds / kDay) + " days";
}

}  // namespace

std::optional<std::string> EndWatch::Look(std::int64_t now) {
  if (ended(now)) {
    if (told_ended_ && now - *told_ended_ < kAgain) return std::nullopt;
    told_ended_ = now;
    return what_ + " ended at " + DateText(end_) +
           ": no secured program hears this one any more; make new credentials (collisionctl "
           "make-certificates) and start it again";
  }
  const auto* const ahead = std::lower_bound(std::begin(kAhead), std::end(kAhead), end_ - now);
  if (ahead == std::end(kAhead) || (told_ahead_ && *told_ahead_ <= *ahead)) return std::nullopt;
  told_ahead_ = *ahead;
  return what_ + " ends in " + LeftText(end_ - now) + ", at " + DateText(end_) +
         ": make new credentials (collisionctl make-certificates) and start this program again "
         "before";
}

}  // namespace collision::credentials
