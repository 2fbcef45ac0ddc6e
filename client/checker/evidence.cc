#include "client/checker/evidence.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <utility>

#include "client/checker/level_visits.h"
#include "client/checker/who_meets.h"

namespace collision::checker {
namespace {

AgentKey Key(const v1::AgentId& id) {
  return {id.simulator_id(), id.run(), id.slot(), id.generation()};
}

std::int64_t JudgedUntil(const std::vector<AgentMotion>& motions, std::int64_t transit_ns) {
  std::map<std::string, std::int64_t> end, period;
  for (const AgentMotion& motion : motions) {
    end.try_emplace(motion.simulator, std::numeric_limits<std::int64_t>::min());
    end[motion.simulator] = std::max(end[motion.simulator], motion.end_ns());
    if (motion.half_space) continue;  // one piece is its whole motion
    // The last piece may be cut short by the run's end: the one before counts too.
    for (std::size_t i = motion.pieces.size(); i-- > 0 && i + 2 >= motion.pieces.size();) {
      const std::int64_t length = motion.pieces[i].t1_ns - motion.pieces[i].t0_ns;
      period[motion.simulator] = std::max(period[motion.simulator], length);
    }
  }
  std::int64_t until = std::numeric_limits<std::int64_t>::max();
  for (const auto& [simulator, end_ns] : end) until = std::min(until, end_ns - period[simulator]);
  return motions.empty() ? 0 : until - transit_ns;
}

// A pair with hysteresis has certainly been farther apart for the service if it was so for longer
// than three times its temporal resolution, by default of 1/60 s.
long double ApartMin(const v1::Config& config) {
  const double resolution = config.has_temporal_resolution_s() ? config.temporal_resolution_s() : 0;
  return 3e9L * (resolution > 0 ? resolution : 1.0L / 60);
}

// The agents, each grown by half of a margin.
std::vector<AgentMotion> Grown(std::vector<AgentMotion> motions, double margin_m) {
  for (AgentMotion& motion : motions) motion.margin_m += margin_m / 2;
  return motions;
}

bool IsFinal(v1::EventStatus status) {
  return status != v1::EVENT_POSSIBLE && status != v1::EVENT_CONFIRMED;
}

}  // namespace

bool IsConfirmed(const v1::CollisionEvent& event) {
  return event.status() == v1::EVENT_CONFIRMED || event.status() == v1::EVENT_ENDED;
}

bool Moment::IsAfter(const Moment& other) const {
  const bool same_service = stamp.sequence() > 0 && stamp.service_id() == other.stamp.service_id();
  if (!same_service || other.stamp.sequence() == 0) return now_ns > other.now_ns;
  return std::pair(stamp.term(), stamp.sequence()) >
         std::pair(other.stamp.term(), other.stamp.sequence());
}

Evidence::Evidence(std::vector<AgentMotion> motions, const Observations& observations,
                   const RunFacts& facts)
    : motions_(std::move(motions)),
      observations_(observations),
      facts_(facts),
      judged_until_ns_(JudgedUntil(motions_, facts.transit_ns)) {
  contacts_ = TrueContacts(motions_, [this](const AgentMotion& a, const AgentMotion& b) {
    return CanMeet(facts_.config, a, b);
  });
  FindEvents();
  for (const v1::Level& level : facts.config.levels()) {
    levels_.push_back(Evidence(motions_, observations, facts, level));
  }
}

Evidence::Evidence(std::vector<AgentMotion> motions, const Observations& observations,
                   const RunFacts& facts, const v1::Level& level)
    : motions_(Grown(std::move(motions), level.margin_m())),
      observations_(observations),
      facts_(facts),
      level_(level),
      judged_until_ns_(JudgedUntil(motions_, facts.transit_ns)) {
  const MayMeet may_meet = [this](const AgentMotion& a, const AgentMotion& b) {
    return CanMeet(facts_.config, a, b) && Watches(*level_, a, b);
  };
  contacts_ = TrueContacts(motions_, may_meet);
  if (level.hysteresis_m() > 0) {
    NumberVisits(TrueContacts(Grown(motions_, level.hysteresis_m()), may_meet),
                 ApartMin(facts.config), &contacts_);
  }
  FindEvents();
}

void Evidence::FindEvents() {
  by_agent_.resize(motions_.size());
  for (const TrueContact& contact : contacts_) {
    by_agent_[contact.a].push_back(&contact);
    by_agent_[contact.b].push_back(&contact);
  }
  std::map<std::pair<std::string, std::string>, std::size_t> by_name;
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    by_name[{motions_[i].simulator, motions_[i].agent}] = i;
  }
  for (const v1::AgentName& name : observations_.names) {
    const auto found = by_name.find({name.simulator(), name.agent()});
    if (found != by_name.end()) ids_[Key(name.id())] = found->second;
  }
  const std::string about = level_ ? level_->name() : "";
  for (const v1::CollisionEvent& event : observations_.events) {
    if (event.level() == about) Sort(event);
  }
}

void Evidence::Sort(const v1::CollisionEvent& event) {
  const Moment moment{event.now_ns(), event.stamp()};
  auto a = MotionOf(event.lower()), b = MotionOf(event.higher());
  if (!a || !b) {
    strange_events_.push_back(event);
    return;
  }
  if (*a > *b) std::swap(a, b);
  auto& indices = histories_of_[{*a, *b}];
  const auto same = [&](std::size_t i) {
    const v1::CollisionEvent& other = histories_[i].last();
    return other.contact() == event.contact() && Key(other.lower()) == Key(event.lower()) &&
           Key(other.higher()) == Key(event.higher());
  };
  const auto found = std::find_if(indices.begin(), indices.end(), same);
  const std::size_t index = found != indices.end() ? *found : histories_.size();
  if (found == indices.end()) {
    indices.push_back(index);
    histories_.push_back({*a, *b, moment, std::nullopt, std::nullopt, {}});
  }
  EventHistory& history = histories_[index];
  // Contacts and forecasts come through two topics: an older revision may come later.
  if (history.announced.IsAfter(moment)) history.announced = moment;
  // A service that takes over counts them anew.
  const auto number = [](const v1::CollisionEvent& of) {
    return std::pair(of.stamp().term(), of.revision());
  };
  if (!history.revisions.empty() && number(event) <= number(history.last())) return;
  // A service that takes over may forecast the pair again under the number of what was dismissed.
  if (history.closed && !IsFinal(event.status())) {
    history.announced = moment;
    history.closed.reset();
  }
  const bool confirmed = IsConfirmed(event);
  if (confirmed && !history.confirmed) history.confirmed = moment;
  if (IsFinal(event.status()) && !history.closed) history.closed = moment;
  history.revisions.push_back(event);
}

std::vector<const EventHistory*> Evidence::HistoriesOf(std::size_t a, std::size_t b) const {
  std::vector<const EventHistory*> result;
  const auto found = histories_of_.find({a, b});
  if (found == histories_of_.end()) return result;
  for (const std::size_t i : found->second) result.push_back(&histories_[i]);
  return result;
}

std::optional<std::size_t> Evidence::MotionOf(const v1::AgentId& id) const {
  const auto found = ids_.find(Key(id));
  if (found == ids_.end()) return std::nullopt;
  return found->second;
}

std::size_t Evidence::contacts_certain() const {
  return static_cast<std::size_t>(std::count_if(contacts_.begin(), contacts_.end(),
                                                [](const TrueContact& c) { return c.certain; }));
}

bool Evidence::Changed(std::size_t a, std::size_t b, std::int64_t from_ns,
                       long double to_ns) const {
  const std::int64_t from = from_ns - facts_.transit_ns;
  for (const std::size_t i : {a, b}) {
    const AgentMotion& motion = motions_[i];
    if (motion.begin_ns() >= from && motion.begin_ns() <= to_ns) return true;
    const auto jump = std::lower_bound(motion.jumps_ns.begin(), motion.jumps_ns.end(), from);
    if (jump != motion.jumps_ns.end() && *jump <= to_ns) return true;
  }
  return false;
}

bool Evidence::MayHaveLeft(std::size_t a, std::size_t b, long double at_ns) const {
  const std::int64_t end = std::min(motions_[a].end_ns(), motions_[b].end_ns());
  return at_ns >= end - facts_.leaving_ns;
}

std::string Evidence::PairName(std::size_t a, std::size_t b) const {
  const std::string pair = motions_[a].agent + " × " + motions_[b].agent;
  return level_ ? pair + ", level " + level_->name() : pair;
}

std::string Evidence::Time(long double instant_ns) const {
  if (instant_ns >= static_cast<long double>(std::numeric_limits<std::int64_t>::max()))
    return "never";
  char text[64];
  std::snprintf(text, sizeof text, "%.9Lf s", (instant_ns - facts_.start_ns) * 1e-9L);
  return text;
}

}  // namespace collision::checker
