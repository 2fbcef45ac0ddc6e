// States sent on demand, of those that a stream would send.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/bench/service/parts.h"
#include "tests/client/service/in_process_service.h"
#include "tests/support/random.h"

namespace collision::bench {
namespace {

using Eigen::Vector3d;
using namespace std::chrono_literals;

constexpr std::int64_t kPeriodNs = 1'000'000'000 / 60;
constexpr double kAnnounceWithin = 2;   // [s] the service's default
constexpr double kGrantAheadMax = 0.1;  // [s] as in the demo scenes: an answer ends a round
constexpr double kWarmUp = 1;           // [s], in which every agent sends its first state

struct Swarm {
  std::uint32_t agents;
  double acceleration_max;  // M [m/s²]
  double spacing;           // one agent for each cube of so many metres
  double speed;             // [m/s]
};

/// Flies from one random place of a box to the next.
struct Drone {
  Vector3d p, v, goal;
};

class Flight {
 public:
  explicit Flight(const Swarm& swarm)
      : swarm_(swarm), edge_(swarm.spacing * std::cbrt(swarm.agents)) {
    for (std::uint32_t i = 0; i < swarm.agents; ++i) {
      drones_.push_back({Place(), Vector3d::Zero(), Place()});
    }
  }

  const std::vector<Drone>& drones() const { return drones_; }

  /// Acceleration is constant over a step, and no more than M: exactly what is declared.
  void Advance(double dt) {
    for (Drone& drone : drones_) {
      Vector3d way = drone.goal - drone.p;
      if (way.norm() < swarm_.spacing / 4) drone.goal = Place();
      const Vector3d wanted = way.normalized() * swarm_.speed;
      Vector3d a = (wanted - drone.v) / 0.5;
      if (a.norm() > 0.999 * swarm_.acceleration_max) {
        a *= 0.999 * swarm_.acceleration_max / a.norm();
      }
      drone.p += drone.v * dt + a * (dt * dt / 2);
      drone.v += a * dt;
    }
  }

 private:
  Vector3d Place() {
    return {random_.Uniform(0, edge_), random_.Uniform(0, edge_), random_.Uniform(0, edge_)};
  }

  const Swarm swarm_;
  const double edge_;
  Random random_{5};
  std::vector<Drone> drones_;
};

client::State StateOf(const Drone& drone, std::int64_t stamp_ns) {
  client::State state;
  state.stamp_ns = stamp_ns;
  state.position_m = {drone.p.x(), drone.p.y(), drone.p.z()};
  state.velocity_m_s = {drone.v.x(), drone.v.y(), drone.v.z()};
  return state;
}

struct Counts {
  double set = 0, sent = 0;
};

Counts Fly(const Swarm& swarm, double seconds) {
  v1::Config config;
  config.mutable_clock()->set_kind(v1::Clock::LOCK_STEP);
  config.mutable_clock()->set_grant_ahead_max_s(kGrantAheadMax);
  config.set_announce_within_s(kAnnounceWithin);
  client::InProcessService service(config, 0);
  client::WorldOptions options;
  options.simulator = "swarm";
  client::World world = service.Connect(1, options);
  Flight flight(swarm);
  std::vector<client::Agent> agents;
  client::AgentDescription description;
  description.radius_m = 0.5;
  description.acceleration_max_m_s2 = swarm.acceleration_max;
  for (const Drone& drone : flight.drones()) {
    description.name = "d" + std::to_string(agents.size());
    agents.push_back(world.AddAgent(description, StateOf(drone, 0)));
  }
  world.OnEvent([](const client::Event&) {});
  client::Traffic before;
  const auto steps = static_cast<std::int64_t>((kWarmUp + seconds) * 60);
  for (std::int64_t i = 1; i <= steps; ++i) {
    flight.Advance(1e-9 * static_cast<double>(kPeriodNs));
    for (std::size_t k = 0; k < agents.size(); ++k) {
      agents[k].SetState(StateOf(flight.drones()[k], i * kPeriodNs));
    }
    if (world.AdvanceTo(i * kPeriodNs, 10s) == client::Advance::kTimeout) break;
    // Time is granted far ahead: the service answers each step all the same.
    service.Step(1e-9 * static_cast<double>(kPeriodNs));
    if (i == static_cast<std::int64_t>(kWarmUp * 60)) before = world.traffic();
  }
  const client::Traffic& after = world.traffic();
  return {static_cast<double>(after.states_set - before.states_set),
          static_cast<double>(after.states_sent - before.states_sent)};
}

/// What makes a state be wanted soon: how near others may come by flying on, or by accelerating,
/// each in the time in which they cover half the way between two.
std::string LimitOf(const Swarm& swarm) {
  const double by_speed = swarm.spacing / (2 * swarm.speed);
  const double by_acceleration = std::sqrt(swarm.spacing / swarm.acceleration_max);
  if (std::min(by_speed, by_acceleration) < kAnnounceWithin)
    return "meetings within announce_within";
  return by_speed < by_acceleration ? "speed" : "acceleration";
}

void Measure(const std::string& what, const Swarm& swarm, const ServiceSettings& settings,
             ServiceReport* report, const std::string& figure) {
  const std::string name = "messages/" + what;
  if (!settings.Wants(name)) return;
  std::fprintf(stderr, "bench: %s\n", name.c_str());
  const Counts counts = Fly(swarm, settings.quick ? 1 : 10);
  const double ratio = counts.sent > 0 ? counts.set / counts.sent : counts.set;
  const std::string limit = LimitOf(swarm);
  report->Add({Padded(name, 34) +
                   Padded(Format("%.0f of ", counts.sent) + Format("%.0f states", counts.set), 28) +
                   Padded(Format("%.3g times fewer", ratio), 22) + "limited by " + limit,
               {Text("part", "messages"), Text("sweep", what), Number("agents", swarm.agents),
                Number("acceleration_max_m_s2", swarm.acceleration_max),
                Number("spacing_m", swarm.spacing), Number("speed_m_s", swarm.speed),
                Number("states_of_stream", counts.set), Number("states_on_demand", counts.sent),
                Number("ratio", ratio), Text("limited_by", limit)}});
  if (!figure.empty()) report->Figure(figure, ratio);
}

}  // namespace

void MessagesPart(const ServiceSettings& settings, ServiceReport* report) {
  const Swarm base{
      .agents = settings.quick ? 64u : 216u, .acceleration_max = 5, .spacing = 40, .speed = 5};
  Measure("base", base, settings, report, "messages_saved_ratio");
  for (const double value : {0.05, 0.5, 50.0}) {
    Swarm swarm = base;
    swarm.acceleration_max = value;
    Measure("acceleration=" + Format("%g", value), swarm, settings, report, "");
  }
  for (const double value : {10.0, 20.0, 160.0, 640.0}) {
    Swarm swarm = base;
    swarm.spacing = value;
    Measure("spacing=" + Format("%g", value), swarm, settings, report, "");
  }
  for (const double value : {1.0, 15.0, 50.0}) {
    Swarm swarm = base;
    swarm.speed = value;
    Measure("speed=" + Format("%g", value), swarm, settings, report, "");
  }
}

}  // namespace collision::bench
