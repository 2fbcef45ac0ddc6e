#include "client/programs/simulators/spaceship/spaceship_screen.h"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "client/library/network/conversion.h"
#include "collision/event_text.h"

namespace collision::client {
namespace {

using std::chrono::steady_clock;

constexpr std::chrono::milliseconds kDrawPeriod{80};
constexpr std::size_t kLinesKept = 100;
constexpr double kAgeMax = 1;  // [s] a state is not extrapolated further than this

Vector3 PositionAt(const v1::AgentState& state, std::int64_t now_ns) {
  const double age =
      std::clamp(static_cast<double>(now_ns - state.stamp_ns()) * 1e-9, 0.0, kAgeMax);
  return {state.position_m().x() + age * state.velocity_m_s().x(),
          state.position_m().y() + age * state.velocity_m_s().y(),
          state.position_m().z() + age * state.velocity_m_s().z()};
}

std::string ClearanceText(const OwnShip& own) {
  const Clearance& clearance = own.clearance;
  if (clearance.clear_until_ns == std::numeric_limits<std::int64_t>::min()) return "";
  if (clearance.clear_until_ns == kNever) return "clear forever";
  if (clearance.clear_until_ns <= own.now_ns) return "NOT CLEAR";
  return "clear for " + SecondsText(clearance.clear_until_ns, own.now_ns, 2) + " s";
}

}  // namespace

SpaceshipScreen::SpaceshipScreen(const std::string& world, std::uint32_t domain)
    : draw_at_(steady_clock::now()), monitor_({world, domain, true, true}, view_.Callbacks()) {}

void SpaceshipScreen::Update(const OwnShip& own) {
  const double now_s = static_cast<double>(own.now_ns - own.start_ns) * 1e-9;
  typed_ += terminal_.Read();
  for (const HelmKey key : TakeKeys(&typed_)) helm_.Press(key, now_s);
  monitor_.Poll(std::chrono::nanoseconds(0));
  TakeEvents(own);
  if (steady_clock::now() < draw_at_) return;
  draw_at_ = steady_clock::now() + kDrawPeriod;
  const TerminalSize size = terminal_.size();
  terminal_.Draw(PanelLines(Panel(own), size.columns, size.rows));
}

void SpaceshipScreen::TakeEvents(const OwnShip& own) {
  const auto now = steady_clock::now();
  for (const v1::CollisionEvent& message : view_.TakeEvents()) {
    if (message.level().empty()) pending_names_.Add(FromMessage(message), now);
  }
  const auto named = [this](const AgentId& id) { return view_.IsNamed(id); };
  for (const Event& event : pending_names_.Take(named, now)) {
    for (const AgentId& id : {event.lower, event.higher}) {
      const std::pair key(id.simulator, id.slot);
      if (event.status == EventStatus::kConfirmed) {
        touching_.insert(key);
      } else if (event.status != EventStatus::kPossible) {
        touching_.erase(key);
      }
    }
    if (!IsDecided(event.status)) continue;  // there are many possible events
    lines_.push_back(EventLine(
        event, [this](const AgentId& id) { return view_.Name(id); }, own.start_ns));
    if (lines_.size() > kLinesKept) lines_.pop_front();
  }
}

std::string SpaceshipScreen::EarliestText(const OwnShip& own) const {
  const auto& earliest = view_.earliest();
  if (!earliest || !earliest->found()) return "";
  const std::int64_t left_ns = std::max<std::int64_t>(0, earliest->earliest_ns() - own.now_ns);
  return view_.Name(FromMessage(earliest->lower())) + " × " +
         view_.Name(FromMessage(earliest->higher())) + " in " + SecondsText(left_ns, 0, 2) + " s";
}

void SpaceshipScreen::AddOthers(const OwnShip& own, SpaceshipPanel* panel) const {
  double least = std::numeric_limits<double>::infinity();
  for (const AgentView& other : view_.Agents()) {
    const v1::AgentDescription& description = other.description;
    const bool is_own =
        description.simulator_id() == own.id.simulator && description.slot() == own.id.slot;
    if (is_own || !other.state) continue;
    const Vector3 position = PositionAt(*other.state, own.now_ns);
    panel->radar.others.push_back(
        {position, touching_.contains({description.simulator_id(), description.slot()})});
    const double distance = Norm(Difference(position, panel->radar.own_m));
    if (distance >= least) continue;
    least = distance;
    char text[32];
    std::snprintf(text, sizeof text, ", %.1f m", distance);
    panel->nearest = description.agent_name() + text;
  }
}

SpaceshipPanel SpaceshipScreen::Panel(const OwnShip& own) const {
  const RigidState& state = own.ship->state();
  SpaceshipPanel panel;
  panel.time_s = static_cast<double>(own.now_ns - own.start_ns) * 1e-9;
  panel.speed_m_s = Norm(state.velocity_m_s);
  panel.thrust = own.thrust;
  panel.turn_rate_rad_s = Norm(state.angular_velocity_rad_s);
  panel.braking = helm_.braking();
  panel.clearance = ClearanceText(own);
  panel.earliest = EarliestText(own);
  panel.radar.own_m = state.position_m;
  panel.radar.heading = own.ship->heading();
  panel.zoom = helm_.zoom();
  panel.events.assign(lines_.begin(), lines_.end());
  panel.bounces = own.bounces;
  panel.help = helm_.help();
  AddOthers(own, &panel);
  return panel;
}

}  // namespace collision::client
