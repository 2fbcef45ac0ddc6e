#include "server/claim/service_claim.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <limits>

namespace collision::server {
namespace {

std::string Name(const HeardService& service) {
  return fmt::format("service {:016x}, term {}", service.instance, service.term);
}

}  // namespace

void ServiceClaim::Hear(const HeardService& heard, std::int64_t now_ns) {
  if (heard.instance == options_.instance) return;
  highest_heard_ = std::max(highest_heard_, heard.term);
  auto known = others_.find(heard.instance);
  if (known == others_.end()) {
    std::erase_if(others_, [&](const auto& other) {
      return now_ns - other.second.heard_ns > options_.heard_for_ns;
    });
    if (others_.size() == kOthersMax) return;
    known = others_.try_emplace(heard.instance).first;
  } else if (known->second.newest.sequence == heard.sequence) {
    return;
  }
  known->second.newest = heard;
  known->second.heard_ns = now_ns;
  ++known->second.samples;
}

void ServiceClaim::HearOfTerm(std::uint32_t term) {
  if (term != std::numeric_limits<std::uint32_t>::max())
    highest_heard_ = std::max(highest_heard_, term);
}

/// Whether `other` keeps the world and this service leaves it.
bool ServiceClaim::GoesFirst(const HeardService& other) const {
  if (phase_ == ClaimPhase::kClaiming) {
    return other.serving || other.instance < options_.instance;
  }
  if (!other.serving) return false;
  return other.term != term_ ? other.term > term_ : other.instance < options_.instance;
}

void ServiceClaim::Yield(const std::string& why) {
  phase_ = ClaimPhase::kYielded;
  why_ = why;
}

void ServiceClaim::Update(std::int64_t now_ns) {
  if (phase_ == ClaimPhase::kYielded) return;
  if (!since_ns_) since_ns_ = now_ns;
  const std::uint64_t samples_wanted = phase_ == ClaimPhase::kServing ? 2 : 1;
  for (const auto& [instance, other] : others_) {
    if (now_ns - other.heard_ns > options_.heard_for_ns) continue;
    if (other.samples < samples_wanted || !GoesFirst(other.newest)) continue;
    if (phase_ == ClaimPhase::kServing) {
      return Yield(Name(other.newest) + " serves this world too and goes before term " +
                   std::to_string(term_));
    }
    return Yield(Name(other.newest) +
                 (other.newest.serving ? " serves this world" : " is starting in this world too"));
  }
  if (phase_ == ClaimPhase::kServing || now_ns - *since_ns_ < options_.wait_ns) return;
  const std::uint32_t highest = std::max(highest_heard_, options_.term_before);
  term_ = highest == std::numeric_limits<std::uint32_t>::max() ? highest : highest + 1;
  phase_ = ClaimPhase::kServing;
  // What was heard before says nothing about whether it is there beside this service now.
  others_.clear();
}

std::optional<std::int64_t> ServiceClaim::NextDue() const {
  if (phase_ != ClaimPhase::kClaiming || !since_ns_) return std::nullopt;
  return *since_ns_ + options_.wait_ns;
}

bool ServiceClaim::IsContended(std::int64_t now_ns) const {
  return std::any_of(others_.begin(), others_.end(), [now_ns](const auto& other) {
    return other.second.newest.serving && now_ns - other.second.heard_ns <= kContendedForNs;
  });
}

std::vector<std::string> ServiceClaim::Conflicts(std::int64_t now_ns) const {
  std::vector<std::string> lines;
  if (phase_ != ClaimPhase::kServing) return lines;
  for (const auto& [instance, other] : others_) {
    if (now_ns - other.heard_ns > options_.heard_for_ns || !other.newest.serving) continue;
    lines.push_back(Name(other.newest) + " publishes in this world beside term " +
                    std::to_string(term_));
  }
  return lines;
}

}  // namespace collision::server
