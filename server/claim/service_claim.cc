#include "server/claim/service_claim.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <limits>

#include "idl/identity.h"

namespace collision::server {
namespace {

/// Of a standby that has heard of no service that serves.
constexpr std::uint32_t kUnknownTerm = std::numeric_limits<std::uint32_t>::max();

}  // namespace

std::string NameOf(const HeardService& service) {
  const std::string process = service.process.empty() ? "" : " (" + service.process + ")";
  const std::string name = "service " + IdText(service.instance) + process;
  return service.term == kUnknownTerm ? name : fmt::format("{}, term {}", name, service.term);
}

void ServiceClaim::Hear(const HeardService& heard, std::int64_t now_ns) {
  if (heard.instance == options_.instance) return;
  if (heard.phase == OtherPhase::kServing) {
    highest_heard_ = std::max(highest_heard_, heard.term);
    contended_ns_ = now_ns;
  }
  auto known = others_.find(heard.instance);
  if (known == others_.end()) {
    // The network tells when one has ended; what was only forged makes room.
    if (others_.size() == kOthersMax) {
      std::erase_if(others_, [&](const auto& other) {
        return now_ns - other.second.heard_ns > options_.heard_for_ns;
      });
    }
    if (others_.size() == kOthersMax) return;
    known = others_.try_emplace(heard.instance).first;
  } else if (known->second.newest.sequence == heard.sequence) {
    return;
  }
  known->second.newest = heard;
  known->second.heard_ns = now_ns;
  ++known->second.samples;
}

void ServiceClaim::HearClock(std::uint64_t service, std::uint32_t term) {
  is_named_ = is_named_ || (is_unheard_ && (service == options_.instance || service == 0));
  // A replay that begins in the middle of a run hears of itself.
  const std::uint32_t known = std::max({highest_heard_, options_.term_before, term_});
  if (service == options_.instance || term <= known || term - known > kTermLeapMax) return;
  highest_heard_ = term;
}

bool ServiceClaim::BeginsToSpeak() {
  if (phase_ != ClaimPhase::kServing || !is_unheard_ || !is_named_) return false;
  is_unheard_ = false;
  return true;
}

/// Whether `other` keeps the world and this service leaves it.
bool ServiceClaim::GoesFirst(const HeardService& other) const {
  if (phase_ == ClaimPhase::kClaiming) {
    // Who stands by for one that is starting may stand by for this one.
    const bool stands_by = other.phase == OtherPhase::kStandby && other.term != kUnknownTerm;
    return other.phase == OtherPhase::kServing || stands_by || other.instance < options_.instance;
  }
  if (other.phase != OtherPhase::kServing) return false;
  // A service that wakes up counted its followers before it slept.
  if (phase_ != ClaimPhase::kWaking && other.followed != followed_) return other.followed;
  return other.term != term_ ? other.term > term_ : other.instance < options_.instance;
}

void ServiceClaim::Yield(const HeardService& other, const std::string& why) {
  standby_term_ = other.phase == OtherPhase::kServing ? other.term : kUnknownTerm;
  const bool stands_by = options_.stands_by && phase_ == ClaimPhase::kClaiming;
  phase_ = stands_by ? ClaimPhase::kStandby : ClaimPhase::kYielded;
  why_ = why;
}

bool ServiceClaim::HasStandby() const {
  return std::any_of(others_.begin(), others_.end(), [](const auto& other) {
    return other.second.newest.phase == OtherPhase::kStandby;
  });
}

std::optional<std::int64_t> ServiceClaim::standstill_ns() const {
  const bool serves = phase_ == ClaimPhase::kServing || phase_ == ClaimPhase::kWaking;
  const bool is_replaceable = serves && (options_.stands_by || HasStandby());
  if (!is_replaceable && phase_ != ClaimPhase::kStandby) return std::nullopt;
  return options_.waking_ns / 2;
}

/// A step waits for as long as the claim; beyond, what came meanwhile has not been taken in yet.
void ServiceClaim::ListenAnew(std::int64_t gap_ns, std::int64_t now_ns) {
  if (gap_ns <= 2 * options_.wait_ns || listened_anew_ == kListensAnewMax) return;
  ++listened_anew_;
  since_ns_ = now_ns;
}

void ServiceClaim::WakeUp(std::int64_t gap_ns, std::int64_t now_ns) {
  if (phase_ == ClaimPhase::kClaiming) return ListenAnew(gap_ns, now_ns);
  const std::optional<std::int64_t> standstill = standstill_ns();
  if (!standstill || gap_ns <= *standstill) return;
  if (phase_ == ClaimPhase::kStandby && gap_ns > kStaleAfterNs) {
    phase_ = ClaimPhase::kYielded;
    why_ = fmt::format("stood still for {:.1f} s while it stood by", 1e-9 * double(gap_ns));
    return;
  }
  const bool again = gap_ns < options_.heard_for_ns && stood_ns_ &&
                     now_ns - gap_ns - *stood_ns_ < options_.waking_ns;
  if (!again) listens_since_ns_ = now_ns;
  stood_ns_ = now_ns;
  if (now_ns - listens_since_ns_ >= options_.heard_for_ns) return;
  woke_ns_ = now_ns;
  if (phase_ == ClaimPhase::kStandby) return;
  phase_ = ClaimPhase::kWaking;
  since_ns_ = now_ns;
}

/// Longer than a service that serves listens: where both stood still that one goes on.
std::int64_t ServiceClaim::StandbyListens() const { return options_.waking_ns * 3 / 2; }

/// What the network said on waking, it said of the time in which this process heard nothing.
bool ServiceClaim::HasJustWoken(std::int64_t now_ns) const {
  return woke_ns_ && now_ns - *woke_ns_ < StandbyListens();
}

/// Leaves the world to another service, if there is one that goes first.
bool ServiceClaim::Yields(std::int64_t now_ns) {
  const std::uint64_t samples_wanted = phase_ == ClaimPhase::kServing ? 2 : 1;
  for (const auto& [instance, other] : others_) {
    if (now_ns - other.heard_ns > options_.heard_for_ns) continue;
    if (other.samples < samples_wanted || !GoesFirst(other.newest)) continue;
    if (phase_ != ClaimPhase::kClaiming) {
      Yield(other.newest, NameOf(other.newest) + " serves this world too and goes before term " +
                              std::to_string(term_));
    } else if (other.newest.phase == OtherPhase::kServing) {
      Yield(other.newest, NameOf(other.newest) + " serves this world");
    } else {
      Yield(other.newest, NameOf(other.newest) + (other.newest.phase == OtherPhase::kStandby
                                                      ? " stands by in this world"
                                                      : " is starting in this world too"));
    }
    return true;
  }
  return false;
}

/// Of two that stand by, whether the other one is to take over. One that is starting leaves the
/// world to a standby (GoesFirst()), unless that one stands by for it.
bool ServiceClaim::WaitsFor(const Other& other) const {
  if (other.newest.phase == OtherPhase::kClaiming && standby_term_ != kUnknownTerm) return false;
  return std::pair(other.newest.term, other.newest.instance) <
         std::pair(standby_term_, options_.instance);
}

bool ServiceClaim::TakesOver(std::int64_t now_ns) {
  const auto serving = std::find_if(others_.begin(), others_.end(), [](const auto& other) {
    return other.second.newest.phase == OtherPhase::kServing;
  });
  if (serving != others_.end()) {
    standby_term_ = std::min(standby_term_, serving->second.newest.term);
    vacant_ns_.reset();
    return false;
  }
  if (!fits_) return false;
  if (!vacant_ns_) vacant_ns_ = now_ns;
  if (HasJustWoken(now_ns)) return false;
  woke_ns_.reset();
  const bool waits = std::any_of(others_.begin(), others_.end(),
                                 [this](const auto& other) { return WaitsFor(other.second); });
  return !waits || now_ns - *vacant_ns_ >= options_.heard_for_ns;
}

void ServiceClaim::Serve(std::int64_t now_ns) {
  contended_ns_.reset();
  is_unheard_ = phase_ == ClaimPhase::kStandby;
  if (is_unheard_) contended_ns_ = now_ns;
  const std::uint32_t highest = std::max({highest_heard_, options_.term_before, term_});
  term_ = highest == std::numeric_limits<std::uint32_t>::max() ? highest : highest + 1;
  phase_ = ClaimPhase::kServing;
  vacant_ns_.reset();
  // What was heard of a service that serves says nothing about whether it is there beside this one.
  std::erase_if(
      others_, [](const auto& other) { return other.second.newest.phase != OtherPhase::kStandby; });
}

void ServiceClaim::Update(std::int64_t now_ns) {
  if (!since_ns_) since_ns_ = now_ns;
  switch (phase_) {
    case ClaimPhase::kYielded:
      return;
    case ClaimPhase::kStandby:
      if (TakesOver(now_ns)) Serve(now_ns);
      return;
    case ClaimPhase::kClaiming:
      if (!Yields(now_ns) && now_ns - *since_ns_ >= options_.wait_ns) Serve(now_ns);
      return;
    case ClaimPhase::kWaking:
      if (Yields(now_ns) || now_ns - *since_ns_ < options_.waking_ns) return;
      phase_ = ClaimPhase::kServing;
      return;
    case ClaimPhase::kServing:
      Yields(now_ns);
      return;
  }
}

std::optional<std::int64_t> ServiceClaim::NextDue() const {
  if (!since_ns_) return std::nullopt;
  if (phase_ == ClaimPhase::kClaiming) return *since_ns_ + options_.wait_ns;
  if (phase_ == ClaimPhase::kWaking) return *since_ns_ + options_.waking_ns;
  if (phase_ == ClaimPhase::kStandby && vacant_ns_) {
    return woke_ns_ ? *woke_ns_ + StandbyListens() : *vacant_ns_ + options_.heard_for_ns;
  }
  return std::nullopt;
}

bool ServiceClaim::IsContended(std::int64_t now_ns) const {
  return contended_ns_ && now_ns - *contended_ns_ <= kContendedForNs;
}

std::vector<std::string> ServiceClaim::Conflicts(std::int64_t now_ns) const {
  std::vector<std::string> lines;
  if (phase_ != ClaimPhase::kServing) return lines;
  for (const auto& [instance, other] : others_) {
    if (now_ns - other.heard_ns > options_.heard_for_ns) continue;
    if (other.newest.phase != OtherPhase::kServing) continue;
    lines.push_back(NameOf(other.newest) + " publishes in this world beside term " +
                    std::to_string(term_));
  }
  return lines;
}

}  // namespace collision::server
