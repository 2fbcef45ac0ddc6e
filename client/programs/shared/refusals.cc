#include "client/programs/shared/refusals.h"

#include <algorithm>
#include <cstdio>
#include <set>

namespace collision::client {
namespace {

constexpr const char* kOwned = "REJECTED_ID_OWNED";
constexpr std::chrono::seconds kOwnedLately{2};  // The library repeats everything more often.

const std::set<std::string> kFatal = {"REJECTED_NOT_FINITE",      "REJECTED_OUT_OF_RANGE",
                                      "REJECTED_ID_MISMATCH",     "REJECTED_FUTURE_STAMP",
                                      "REJECTED_TOO_MANY_AGENTS", "REJECTED_TOO_MANY_SIMULATORS",
                                      "REJECTED_OLD_RUN",         "REJECTED_CLOCK_BEYOND_GRANT",
                                      "REJECTED_CHUNK_TOO_LARGE", "REJECTED_BAD_SHAPE",
                                      "REJECTED_MISMATCH"};

}  // namespace

void Refusals::Add(const std::vector<Rejection>& rejections, Wall now) {
  for (const Rejection& rejection : rejections) {
    count_ = std::max(count_, rejection.count);
    if (rejection.reason == kOwned) owned_at_ = now;
    if (++reasons_[rejection.reason] > 1) continue;
    std::fprintf(stderr, "%s: the service refused %s of slot %u: %s, %s: %s\n", simulator_.c_str(),
                 rejection.topic.c_str(), rejection.slot, rejection.reason.c_str(),
                 rejection.field.c_str(), rejection.detail.c_str());
  }
}

std::string Refusals::Summary() const {
  if (reasons_.empty()) return "";
  std::string text = "the service refused " + std::to_string(count_) + " samples; reported:";
  const char* separator = " ";
  for (const auto& [name, count] : reasons_) {
    text += separator + name + " " + std::to_string(count);
    separator = ", ";
  }
  return text;
}

std::optional<std::string> Refusals::fatal(Wall now) const {
  for (const auto& [name, count] : reasons_) {
    if (kFatal.contains(name)) return name;
  }
  if (owned_at_ && now - *owned_at_ < kOwnedLately) return kOwned;
  return std::nullopt;
}

}  // namespace collision::client
