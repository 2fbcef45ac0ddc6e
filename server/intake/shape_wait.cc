#include "server/intake/shape_wait.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "server/shapes/shape_store.h"

namespace collision::server {

bool ShapeWait::Holds(std::int64_t now_ns) const {
  return std::any_of(waits_.begin(), waits_.end(),
                     [&](const auto& wait) { return now_ns - wait.second.since_ns < limit_ns_; });
}

std::optional<std::int64_t> ShapeWait::NextDue() const {
  std::optional<std::int64_t> next;
  const auto consider = [&next](std::int64_t due) { next = next ? std::min(*next, due) : due; };
  for (const auto& [hash, wait] : waits_) {
    if (!wait.told) consider(wait.since_ns + kShapeWaitTold);
    if (!wait.given_up) consider(wait.since_ns + limit_ns_);
  }
  return next;
}

std::vector<std::string> ShapeWait::TakeLines(std::int64_t now_ns) {
  std::vector<std::string> lines;
  for (auto& [hash, wait] : waits_) {
    const std::int64_t waited_ns = now_ns - wait.since_ns;
    if (!wait.given_up && waited_ns >= limit_ns_) {
      wait.given_up = wait.told = true;
      lines.push_back(fmt::format(
          "shape {} is not there after {} s: time goes on, its agents count as their balls",
          ShortHash(hash), 1e-9 * static_cast<double>(waited_ns)));
    } else if (!wait.told && waited_ns >= kShapeWaitTold) {
      wait.told = true;
      lines.push_back(fmt::format("time waits for shape {}, for at most {} s", ShortHash(hash),
                                  1e-9 * static_cast<double>(limit_ns_)));
    }
  }
  return lines;
}

std::vector<std::string> ShapeWait::Waiting(std::int64_t now_ns) const {
  std::vector<std::string> waiting;
  for (const auto& [hash, wait] : waits_) {
    if (now_ns - wait.since_ns < limit_ns_) waiting.push_back("shape " + ShortHash(hash));
  }
  return waiting;
}

}  // namespace collision::server
