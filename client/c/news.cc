#include "client/c/news.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "client/c/given.h"
#include "collision/event_text.h"
#include "collision/shape.h"

namespace collision::client::c {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

static_assert(COLLISION_ENDED == static_cast<int>(EventStatus::kEnded));
static_assert(COLLISION_LIMITED_BY_GEOMETRY == static_cast<int>(EventLimit::kGeometry));
static_assert(COLLISION_NOTICE_NO_SERVICE == 1 + static_cast<int>(NoticeKind::kNoService));
static_assert(COLLISION_NOTICE_CREDENTIALS == 1 + static_cast<int>(NoticeKind::kCredentials));
static_assert(COLLISION_EXPECTED_UNDECIDED == static_cast<int>(ExpectedOutcome::kUndecided));

template <std::size_t size>
void Copy(const std::array<double, size>& from, double (&to)[size]) {
  std::copy(from.begin(), from.end(), to);
}

collision_bracket Copied(const TimeBracket& bracket) {
  return {bracket.earliest_ns, bracket.latest_ns};
}

collision_proximity Copied(const Proximity& from) {
  collision_proximity to{};
  to.at_ns = from.at_ns;
  to.separation_lower_m = from.separation_lower_m;
  to.separation_upper_m = from.separation_upper_m;
  to.depth_lower_m = from.depth_lower_m;
  Copy(from.point_m, to.point_m);
  to.point_error_m = from.point_error_m;
  const Normal normal = from.normal.value_or(Normal{{kUnknown, kUnknown, kUnknown}, kUnknown});
  Copy(normal.direction, to.normal);
  to.normal_error_rad = normal.error_rad;
  const RelativeVelocity relative =
      from.relative_velocity.value_or(RelativeVelocity{{kUnknown, kUnknown, kUnknown}, kUnknown});
  Copy(relative.velocity_m_s, to.relative_velocity_m_s);
  to.relative_velocity_error_m_s = relative.error_m_s;
  to.lower_part = from.lower_part ? std::int64_t{*from.lower_part} : -1;
  to.higher_part = from.higher_part ? std::int64_t{*from.higher_part} : -1;
  return to;
}

collision_state_used Copied(const StateUsed& from) {
  collision_state_used to{};
  to.stamp_ns = from.stamp_ns;
  Copy(from.position_m, to.position_m);
  Copy(from.velocity_m_s, to.velocity_m_s);
  Copy(from.acceleration_m_s2, to.acceleration_m_s2);
  return to;
}

collision_closest_approach Copied(const ClosestApproach& from) {
  return {from.from_ns, from.until_ns, Copied(from.at), from.distance_lower_m,
          from.distance_upper_m};
}

/// Where `from` holds a value, puts it into `to` and points there.
template <class From, class To>
void Put(const std::optional<From>& from, To* to, const To** pointer) {
  if (!from) return;
  *to = Copied(*from);
  *pointer = to;
}

std::vector<const char*> PointersOf(const std::vector<std::string>& texts) {
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  return pointers;
}

/// A name for people: the service tells those of both agents with each event.
std::string NameIn(const Event& event, const AgentId& id) {
  const AgentLabel& label = id == event.lower ? event.lower_label : event.higher_label;
  if (label.simulator.empty()) return "agent " + std::to_string(id.slot) + " of an unknown owner";
  return label.name + " (" + label.simulator + ")";
}

}  // namespace

collision_agent_id ToC(const AgentId& id) { return {id.simulator, id.run, id.slot, id.generation}; }

collision_clearance ToC(const Clearance& from) {
  collision_clearance to{};
  to.struct_size = sizeof to;
  to.not_clear = from.not_clear ? 1 : 0;
  to.saturated = from.saturated ? 1 : 0;
  to.description_counts = from.description_counts ? 1 : 0;
  to.clear_until_ns = from.clear_until_ns;
  to.effective_from_ns = from.effective_from_ns;
  to.void_from_ns = from.void_from_ns;
  to.expires_ns = from.expires_ns;
  to.state_wanted_ns = from.state_wanted_ns;
  to.cause = from.cause.c_str();
  to.cause_agent = ToC(from.cause_agent);
  to.lowerings = from.lowerings;
  return to;
}

News NewsOf(const Notice& notice) {
  return {.kind = COLLISION_NEWS_NOTICE,
          .text = notice.text,
          .over = notice.over,
          .notice = 1 + static_cast<std::int32_t>(notice.kind)};
}

const collision_news* ToldNews::Tell(const News& news) {
  tags_.clear();
  news_ = {};
  news_.struct_size = sizeof news_;
  news_.kind = news.kind;
  news_.agent = ToC(news.agent);
  news_.text = news.text.c_str();
  news_.over = news.over ? 1 : 0;
  news_.notice = news.notice;
  std::visit([this](const auto& value) { Put(value); }, news.value);
  return &news_;
}

const collision_tag* ToldNews::TagsOf(const std::vector<Tag>& tags) {
  std::vector<collision_tag>& all = tags_.emplace_back();
  for (const Tag& tag : tags) all.push_back({tag.key.c_str(), tag.value.c_str()});
  return all.data();
}

void ToldNews::Put(const AgentLabel& label, collision_label* to) {
  *to = {label.simulator.c_str(), label.name.c_str(), label.assembly.c_str(), TagsOf(label.tags),
         label.tags.size()};
}

void ToldNews::Put(const Event& event) {
  event_ = {};
  event_.struct_size = sizeof event_;
  event_.status = static_cast<std::int32_t>(event.status);
  event_.limited_by = static_cast<std::int32_t>(event.limited_by);
  event_.continuous = event.continuous ? 1 : 0;
  event_.began_before = event.began_before ? 1 : 0;
  event_.hypothetical = event.hypothetical ? 1 : 0;
  event_.lower = ToC(event.lower);
  event_.higher = ToC(event.higher);
  Put(event.lower_label, &event_.lower_label);
  Put(event.higher_label, &event_.higher_label);
  event_.level = event.level.c_str();
  event_.because = event.because.c_str();
  event_.contact = event.contact;
  event_.revision = event.revision;
  event_.contacts_sequence = event.contacts_sequence;
  event_.now_ns = event.now_ns;
  event_.begin = Copied(event.begin);
  event_.end = Copied(event.end);
  event_.margin_m = event.margin_m;
  c::Put(event.proximity, &proximity_, &event_.proximity);
  c::Put(event.lower_state, &lower_state_, &event_.lower_state);
  c::Put(event.higher_state, &higher_state_, &event_.higher_state);
  if (event.expected) {
    const Expectation& expected = *event.expected;
    expected_ = {static_cast<std::int32_t>(expected.outcome), Copied(expected.begin), nullptr,
                 expected.until_ns};
    c::Put(expected.closest, &expected_closest_, &expected_.closest);
    event_.expected = &expected_;
  }
  c::Put(event.closest, &closest_, &event_.closest);
  event_.work_units = event.work_units;
  event_.tree_level = event.tree_level;
  sentence_ = EventSentence(
      event, [&](const AgentId& id) { return NameIn(event, id); }, event.now_ns, 0);
  event_.sentence = sentence_.c_str();
  news_.event = &event_;
}

void ToldNews::Put(const Clearance& clearance) {
  clearance_ = ToC(clearance);
  news_.clearance = &clearance_;
}

void ToldNews::Put(const Rejection& rejection) {
  rejection_ = {sizeof rejection_,        rejection.slot,          rejection.simulator,
                rejection.reason.c_str(), rejection.topic.c_str(), rejection.field.c_str(),
                rejection.detail.c_str(), rejection.count,         rejection.lasting ? 1 : 0};
  news_.rejection = &rejection_;
}

void ToldNews::Put(const Breach& breach) {
  breach_ = {sizeof breach_, ToC(breach.agent), breach.field.c_str(), breach.declared,
             breach.seen,    breach.from_ns,    breach.at_ns,         breach.count};
  news_.agent = breach_.agent;
  news_.breach = &breach_;
}

void ToldNews::Put(const ServiceStatus& status) {
  simulators_.clear();
  quotas_.clear();
  for (const SimulatorStatus& simulator : status.simulators) {
    std::vector<collision_quota>& quotas = quotas_.emplace_back();
    for (const auto& [name, quota] : simulator.quotas)
      quotas.push_back({name.c_str(), quota.used, quota.most});
    simulators_.push_back({simulator.simulator, simulator.name.c_str(), simulator.run,
                           simulator.agents, simulator.clock_ns, simulator.granted_until_ns,
                           simulator.states, simulator.rejected, Copied(simulator.clock_offset),
                           simulator.alive ? 1 : 0, simulator.refused_now,
                           simulator.refused_why.c_str(), quotas.data(), quotas.size()});
  }
  counters_.clear();
  for (const auto& [name, value] : status.counters) counters_.push_back({name.c_str(), value});
  histograms_.clear();
  for (const auto& [name, counts] : status.histograms)
    histograms_.push_back({name.c_str(), counts.data(), counts.size()});
  status_ = {sizeof status_,
             status.term,
             status.service,
             status.version.c_str(),
             status.world.c_str(),
             status.lock_step ? 1 : 0,
             status.agents,
             status.pairs_tracked,
             status.now_ns,
             simulators_.data(),
             sizeof(collision_simulator_status),
             simulators_.size(),
             counters_.data(),
             counters_.size(),
             status.build.c_str(),
             status.started_ns,
             status.uptime_ns,
             status.cpu_us,
             status.memory_bytes,
             histograms_.data(),
             histograms_.size()};
  news_.status = &status_;
}

void ToldNews::Put(const EarliestIntersection& earliest) {
  earliest_ = {sizeof earliest_,     earliest.found ? 1 : 0, earliest.now_ns,
               earliest.earliest_ns, ToC(earliest.lower),    ToC(earliest.higher)};
  news_.earliest = &earliest_;
}

void ToldNews::Put(const DescribedAgent& agent) {
  const AgentDescription& from = agent.description;
  description_ = DefaultDescription();
  description_.hypothetical = from.hypothetical ? 1 : 0;
  description_.name = from.name.c_str();
  description_.radius_m = from.radius_m.value_or(kUnknown);
  description_.acceleration_max_m_s2 = from.acceleration_max_m_s2.value_or(kUnknown);
  description_.angular_acceleration_max_rad_s2 =
      from.angular_acceleration_max_rad_s2.value_or(kUnknown);
  description_.speed_max_m_s = from.speed_max_m_s.value_or(kUnknown);
  description_.time_step_s = from.time_step_s.value_or(kUnknown);
  description_.jerk_max_m_s3 = from.jerk_max_m_s3;
  description_.margin_m = from.margin_m;
  description_.class_name = from.class_name.c_str();
  description_.assembly = from.assembly.c_str();
  meets_ = PointersOf(from.meets_in_assembly);
  description_.meets_in_assembly = meets_.data();
  description_.meets_in_assembly_count = meets_.size();
  never_meets_ = PointersOf(from.never_meets);
  description_.never_meets = never_meets_.data();
  description_.never_meets_count = never_meets_.size();
  description_.tags = TagsOf(from.tags);
  description_.tags_count = from.tags.size();
  if (from.half_space) {
    Copy(from.half_space->normal, description_.half_space_normal);
    description_.half_space_offset_m = from.half_space->offset_m;
  }
  news_.agent = ToC(agent.id);
  news_.text = agent.simulator.c_str();
  news_.description = &description_;
}

void ToldNews::Put(const State& from) {
  state_ = DefaultState();
  state_.discontinuity = from.discontinuity ? 1 : 0;
  state_.stamp_ns = from.stamp_ns;
  Copy(from.position_m, state_.position_m);
  Copy(from.velocity_m_s, state_.velocity_m_s);
  Copy(from.acceleration_m_s2, state_.acceleration_m_s2);
  Copy(from.orientation, state_.orientation);
  Copy(from.angular_velocity_rad_s, state_.angular_velocity_rad_s);
  state_.position_error_m = from.position_error_m;
  state_.velocity_error_m_s = from.velocity_error_m_s;
  state_.rotation_error_rad = from.rotation_error_rad;
  Copy(from.thrust_direction.value_or(Vector3{}), state_.thrust_direction);
  state_.direction_until_ns = from.direction_until_ns;
  state_.expiry_ns = from.expiry_ns.value_or(kNever);
  news_.state = &state_;
}

void ToldNews::Put(const SimulatorClock& clock) {
  clock_ = {sizeof clock_, clock.lock_step ? 1 : 0, clock.simulator, clock.name.c_str(), clock.run,
            clock.agents,  clock.clock_ns};
  news_.clock = &clock_;
}

void NewsQueue::Add(News news) {
  if (waiting_.size() == kNewsMax) {
    waiting_.pop_front();
    ++lost_;
  }
  waiting_.push_back(std::move(news));
}

const collision_news* NewsQueue::Take() {
  if (waiting_.empty()) return nullptr;
  taken_ = std::move(waiting_.front());
  waiting_.pop_front();
  return told_.Tell(taken_);
}

}  // namespace collision::client::c
