#include "collision_core/narrow_phase/contact/contact_boundary.h"

#include <algorithm>
#include <cmath>

namespace collision::narrow_phase {
namespace {

// Free steps shorter than this share of the tolerance lead no further.
constexpr double kStallShare = 0.125;

// Steps of a few units in the last place lead no further either.
constexpr double kStallRounding = 0x1p-51;

// Contact is searched half of the tolerance after the last certain freedom, and so many times
// farther each time.
constexpr double kFirstShare = 0.5;
constexpr double kStepGrowth = 4;

// It is not narrowed further where that would make the bracket narrower by less than this share.
constexpr double kWorthNarrowing = 0.0625;

// Queries of the whole bodies begin at this share of what is left.
constexpr double kThoroughShare = 1e-6;

// Beyond where freedom was interrupted they begin at this share of the way there: interruptions may
// follow each other, and are not to be followed one by one. Before that only what may touch first
// is queried.
constexpr double kIslandShare = 0.0625;

// All candidates are tried at first, then only so many of the best.
constexpr std::size_t kCandidatesKept = 4;

// A query of what the bodies sweep in all their turns may cost as much as the sweeps since the last
// such query, and this at least.
constexpr std::uint64_t kRevolveUnits = 4096;

// A contact that begins deepens, so that it lasts about twice as long at each step.
constexpr int kLastingSteps = 64;

// The longest chord by which two orientations can differ [m per m].
constexpr double kAnyWay = 2;

}  // namespace

double ContactBoundary::Moved(double at, double seconds) const {
  return is_backward() ? numeric::AddUp(at, -seconds) : numeric::AddDown(at, seconds);
}

double ContactBoundary::ToleranceAt(double at) const {
  return std::max(tolerance_.absolute, tolerance_.relative * std::abs(at));
}

double ContactBoundary::StallAt(double at) const {
  if (coarse_) return tolerance_.absolute;
  return std::max(kStallShare * ToleranceAt(at), kStallRounding * std::abs(at));
}

bool ContactBoundary::Exhausted() {
  exhausted_ = exhausted_ || work_.exhausted();
  return work_.exhausted();
}

// Queried after one sweep, and if it leads no further than a sweep does, after two more, four, …
double ContactBoundary::RingFreedomFrom(double at, double left, double span, Turns* turns) const {
  if (++turns->sweeps < turns->wait) return 0;
  const std::uint64_t units = std::max(kRevolveUnits, work_.spent() - turns->spent);
  const double free = motion_.RingFreedom(at, left, direction_, duration_, units);
  const bool farther = free > span;
  turns->wait = farther ? 1 : 2 * turns->wait;
  turns->sweeps = 0;
  turns->spent = work_.spent();
  return farther ? free : 0;
}

double ContactBoundary::FreeFrom(double at) {
  Turns turns;
  turns.spent = work_.spent();
  bool asked_inside = false;
  while (!Exhausted()) {
    const double left = is_backward() ? at : numeric::AddUp(duration_, -at);
    const double span = motion_.SpanFrom(at, left, direction_, duration_);
    const double revolved = asked_inside ? RingFreedomFrom(at, left, span, &turns) : 0;
    if (revolved == numeric::kInfinity)
      return is_backward() ? -numeric::kInfinity : numeric::kInfinity;
    if (revolved > 0) {
      at = Moved(at, revolved);
      continue;
    }
    const ShapeMotion::Sweep sweep = motion_.SweepFrom(at, span, direction_, detail_);
    if (!sweep.known) return at;
    touch_ = sweep.touch;
    orientation_unknown_ = std::max(sweep.pose.chord_A, sweep.pose.chord_B) >= kAnyWay;
    // Containment is tested once: later the surfaces stay apart, so nothing gets inside.
    if (!asked_inside && touch_.seconds > 0) {
      asked_inside = true;
      nested_ = !motion_.NeitherInside(sweep.pose);
      if (nested_) return at;
    }
    const bool through = touch_.seconds > span;
    if (through && span >= left) return is_backward() ? -numeric::kInfinity : numeric::kInfinity;
    const double next = Moved(at, std::min(span, touch_.seconds));
    const double advanced = std::abs(next - at);
    at = next;
    if (through) continue;
    exhausted_ = exhausted_ || touch_.exhausted;
    if (touch_.exhausted || advanced <= StallAt(at) || (coarse_ && sweep.final)) break;
  }
  return at;
}

// Records a query; returns whether it shows contact.
bool ContactBoundary::Record(const ShapeMotion::PoseQuery& query) {
  if (!query.choice.certain) return false;
  nearest_ = std::min(nearest_,
                      std::max(0.0, numeric::AddUp(query.bracket.upper, query.pose.translation)));
  return query.touching();
}

bool ContactBoundary::TouchesByCandidates(double at) {
  std::vector<std::pair<double, std::size_t>> by_depth;
  for (std::size_t i = 0; i < candidates_.size() && !Exhausted(); ++i) {
    const ShapeMotion::PoseQuery query = motion_.QuerySeparation(at, candidates_[i]);
    if (Record(query)) {
      std::rotate(candidates_.begin(), candidates_.begin() + static_cast<std::ptrdiff_t>(i),
                  candidates_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      return true;
    }
    by_depth.emplace_back(query.bracket.upper, i);
  }
  if (candidates_.size() > kCandidatesKept && by_depth.size() == candidates_.size()) {
    std::sort(by_depth.begin(), by_depth.end());
    std::vector<ContactCandidate> best;
    for (std::size_t i = 0; i < kCandidatesKept; ++i)
      best.push_back(candidates_[by_depth[i].second]);
    candidates_.swap(best);
  }
  return false;
}

bool ContactBoundary::Touches(double at, Scope scope) {
  apart_ = false;
  if (TouchesByCandidates(at)) return true;
  const ContactWitness leaves = ContactWitness::Leaves(touch_.leaves);
  for (const ContactWitness& witness : {touch_.resolved ? leaves : ContactWitness{}, witness_}) {
    if (witness.is_none() || Exhausted()) continue;
    if (Record(motion_.RecheckWitness(at, witness))) return true;
  }
  if (scope == Scope::kLikely || Exhausted()) return false;
  ShapeMotion::PoseQuery query =
      motion_.QuerySeparation(at, Goal::kYesNo, touch_.resolved ? leaves : ContactWitness{});
  if (nested_) motion_.CheckContainment(&query);
  exhausted_ = exhausted_ || query.bracket.exhausted;
  if (Record(query)) {
    if (!query.bracket.witness.is_none()) witness_ = query.bracket.witness;
    return true;
  }
  apart_ = !nested_ && query.apart();
  return false;
}

// Between an instant that is not known to be of contact and one that is.
double ContactBoundary::Narrow(double apart, double touching, double free, Scope scope) {
  while (!Exhausted()) {
    const double width = std::abs(touching - apart), bracket = std::abs(touching - free);
    if (bracket <= ToleranceAt(touching) || width <= kWorthNarrowing * bracket) break;
    const double middle = apart + 0.5 * (touching - apart);
    if (middle == apart || middle == touching) break;
    (Touches(middle, scope) ? touching : apart) = middle;
  }
  return touching;
}

void ContactBoundary::Prepare(double free) {
  witness_ = {};
  candidates_.clear();
  if (Exhausted()) return;
  candidates_ = motion_.CandidatesAt(free, touch_);
  uncertain_ = motion_.RecheckWitness(free, {}).uncertainty > kExactMotion * motion_.size();
}

double ContactBoundary::FirstStep(double free, double until) const {
  const double rounding = kStallRounding * std::max(std::abs(free), std::abs(until));
  return std::max(kFirstShare * ToleranceAt(free), rounding);
}

double ContactBoundary::Towards(double until, double from, double step) const {
  return is_backward() ? std::max(until, from - step) : std::min(until, from + step);
}

// Contact by queries of what may touch first only.
std::optional<double> ContactBoundary::QuickContact(double free, double until) {
  double before = free;
  for (double step = FirstStep(free, until); !Exhausted(); step *= kStepGrowth) {
    const double at = Towards(until, free, step);
    if (Touches(at, Scope::kLikely)) return Narrow(before, at, free, Scope::kLikely);
    if (at == until) break;
    before = at;
  }
  return std::nullopt;
}

// Contact by queries of the whole bodies. Where one shows that the two are apart again, however
// short the interruption was, the search goes on from where that freedom ends.
std::optional<double> ContactBoundary::ThoroughContact(double free, double until) {
  double from = free, before = free;
  double thorough = kThoroughShare * std::abs(until - free);
  double step = std::max(FirstStep(free, until), thorough);
  for (;;) {
    if (before == until || Exhausted()) return std::nullopt;
    const double at = Towards(until, from, step);
    const bool all = step >= thorough || at == until;
    if (Touches(at, all ? Scope::kEverything : Scope::kLikely)) {
      return Narrow(before, at, free, Scope::kEverything);
    }
    before = at;
    step *= kStepGrowth;
    if (!apart_) continue;
    from = before = FreeFrom(at);
    const bool beyond = is_backward() ? from <= until : from >= until;
    if (beyond) return std::nullopt;
    Prepare(from);
    step = FirstStep(from, until);
    thorough =
        std::max(kThoroughShare * std::abs(until - from), kIslandShare * std::abs(from - free));
  }
}

std::optional<double> ContactBoundary::ContactByCandidates(double free, double until) {
  Prepare(free);
  return candidates_.empty() ? std::nullopt : QuickContact(free, until);
}

double ContactBoundary::LastsFrom(double touching, double until) const {
  double at = touching;
  for (int step = 0; step < kLastingSteps && !candidates_.empty() && !work_.exhausted(); ++step) {
    const ShapeMotion::PoseQuery query = motion_.QuerySeparation(at, candidates_.front());
    const double lasts = query.touching() ? motion_.ContactStep(query, direction_) : 0;
    at = Moved(at, lasts);
    const bool beyond = is_backward() ? at <= until : at >= until;
    if (beyond) return until;
    if (!(lasts > 0)) break;
  }
  return at;
}

std::optional<double> ContactBoundary::ContactAfter(double free, double until) {
  Prepare(free);
  const bool at_once = free == (is_backward() ? duration_ : 0);
  if (at_once && Touches(free, Scope::kEverything)) return free;
  std::optional<double> touching = QuickContact(free, until);
  if (touching && std::abs(*touching - free) <= ToleranceAt(*touching)) return touching;
  const std::optional<double> sooner = ThoroughContact(free, touching.value_or(until));
  return sooner ? sooner : touching;
}

}  // namespace collision::narrow_phase
