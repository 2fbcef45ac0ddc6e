// Programs that write garbage, in their own names and in those of others.
#include <limits>
#include <optional>

#include "idl/identity.h"
#include "server/config/config.h"
#include "tests/faults/cases/cases.h"
#include "tests/faults/cases/fleet.h"

namespace collision::faults {
namespace {

std::string Seed(std::uint64_t seed) { return "seed " + std::to_string(seed) + ": "; }

constexpr std::int64_t kPeriod = 2 * kMillisecond;
/// Slots 0 to 3 of as many simulators as a world may have.
constexpr std::size_t kStrangers = 4 * 64;

/// Writes every few milliseconds, as long as the scene lasts.
class Hostile {
 public:
  Hostile(std::uint64_t seed, Network* network)
      : random_(seed), network_(*network), id_(network->Join(Role::kSimulator, 0, [] {})) {}

  void Go() {
    ++written_;
    network_.Write(id_, Message());
    network_.After(kPeriod, [this] { Go(); });
  }

  /// Likewise, but one state each under ever-new ids, which no name proves.
  void GoAsGhosts() {
    ++written_;
    v1::Input input;
    v1::AgentStates& states = *input.mutable_agent_states();
    states.set_simulator_id(random_.Next());
    states.set_run(1);
    states.add_states()->mutable_orientation()->set_w(1);
    network_.Write(id_, input);
    network_.After(kPeriod, [this] { GoAsGhosts(); });
  }

  /// A service that says once that it serves, in the highest term there is.
  void ClaimOnce() {
    const Network::Id id = network_.Join(Role::kService, 0, [] {});
    v1::Output output;
    v1::ServiceStatus& status = *output.mutable_service_status();
    status.set_service_id(77);
    status.mutable_stamp()->set_service_id(77);
    status.mutable_stamp()->set_term(std::numeric_limits<std::uint32_t>::max());
    status.mutable_stamp()->set_sequence(1);
    status.set_phase(v1::PHASE_SERVING);
    network_.After(kSecond, [this, id, output] {
      network_.Write(id, output);
      network_.After(kSecond / 2, [this, id] { network_.Kill(id); });
    });
  }

  std::uint64_t written() const { return written_; }

 private:
  double Number() {
    const double numbers[] = {std::numeric_limits<double>::quiet_NaN(),
                              std::numeric_limits<double>::infinity(),
                              1e300,
                              -1,
                              0,
                              5e-324,
                              1,
                              -1e16};
    return numbers[random_.Below(std::size(numbers))];
  }
  std::int64_t Stamp() {
    const std::int64_t stamps[] = {std::numeric_limits<std::int64_t>::max(),
                                   std::numeric_limits<std::int64_t>::min(), -1, 0, 5 * kSecond};
    return stamps[random_.Below(std::size(stamps))];
  }
  std::uint32_t Count() {
    const std::uint32_t counts[] = {0, 1, 2, 3, 65536, 0xffffffff};
    return counts[random_.Below(std::size(counts))];
  }
  /// Of a victim, with the incarnation of which it also knows; or one that nobody has.
  std::string Name() {
    const std::string victims[] = {"alpha", "beta", "gamma"};
    if (random_.Chance(0.7)) return victims[random_.Below(3)];
    return "new-" + std::to_string(written_);
  }

  v1::Input Message() {
    v1::Input input;
    const std::string name = Name();
    switch (random_.Below(4)) {
      case 0: {
        v1::AgentDescription& m = *input.mutable_agent_description();
        m.set_simulator_id(SimulatorId(name));
        m.set_simulator_name(random_.Chance(0.2) ? std::string("\x01 odd") : name);
        m.set_agent_name("hostile");
        m.set_slot(Count());
        m.set_incarnation(Count());
        m.set_run(Count());
        m.set_generation(Count());
        m.set_revision(Count());
        m.set_sequence(Count());
        m.set_states_sequence(Count());
        m.set_radius_m(Number());
        m.set_acceleration_max_m_s2(Number());
        break;
      }
      case 1: {
        v1::AgentStates& m = *input.mutable_agent_states();
        m.set_simulator_id(SimulatorId(name));
        m.set_chunk(Count());
        m.set_incarnation(Count());
        m.set_run(Count());
        for (std::uint64_t i = random_.Below(70); i > 0; --i) {
          v1::AgentState& state = *m.add_states();
          state.set_slot(Count());
          state.set_generation(Count());
          state.set_stamp_ns(Stamp());
          state.set_sequence(random_.Next());
          state.mutable_position_m()->set_x(Number());
          state.mutable_velocity_m_s()->set_y(Number());
          state.mutable_orientation()->set_w(Number());
          state.set_discontinuity(random_.Chance(0.5));
        }
        break;
      }
      case 2: {
        v1::AgentRemoval& m = *input.mutable_agent_removal();
        m.set_simulator_id(SimulatorId(name));
        m.set_slot(Count());
        m.set_incarnation(Count());
        m.set_sequence(random_.Next());
        break;
      }
      default: {
        // Of a victim only: a new simulator with a right clock holds time, as it may.
        v1::SimulatorClock& m = *input.mutable_simulator_clock();
        const std::string victim = random_.Chance(0.5) ? "alpha" : "gamma";
        m.set_simulator_id(SimulatorId(victim));
        m.set_simulator_name(victim);
        m.set_incarnation(Count());
        m.set_run(Count());
        m.set_clock_ns(Stamp());
        m.set_next_ns(Stamp());
        m.set_states_sequence(random_.Next());
        m.set_descriptions_sequence(random_.Next());
        m.set_agents(Count());
        m.set_lock_step(random_.Chance(0.8));
        m.set_clearances_sequence(random_.Next());
        m.set_service_id(1);
        break;
      }
    }
    return input;
  }

  Random random_;
  Network& network_;
  const Network::Id id_;
  std::uint64_t written_ = 0;
};

void Garbage(const Setting& setting, Outcome* outcome) {
  for (int i = 0; i < setting.Many(4, 60); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    const Fleet fleet{.network = Faulty(seed), .seed = seed, .strangers = kStrangers};
    const Fingerprint perfect = PerfectEvents(fleet);
    const auto scene = MakeScene(fleet);
    Hostile hostile(seed + 5000, &scene->network());
    Fly(
        fleet, scene.get(), [&] { scene->When(kSecond, [&] { hostile.Go(); }); }, outcome);
    Report(scene->Judged(), seed, outcome);
    ExpectAllHeard(scene->monitor(), seed, outcome);
    const ServiceProgram& service = scene->service();
    // The end of an epoch may come in other steps beside a program that goes on writing.
    const Fingerprint events{service.events_hash(), service.events_count()};
    outcome->Add("runs_with_the_same_events", events == perfect ? 1 : 0);
    outcome->Add("hostile_agents",
                 static_cast<double>(service.counter("agents_admitted")) - 3.0 * fleet.agents);
    outcome->Add("hostile_messages", static_cast<double>(hostile.written()));
    outcome->Greatest("service_simulators",
                      static_cast<double>(service.status().simulators_size()));
    outcome->Expect(static_cast<std::uint32_t>(service.status().simulators_size()) <=
                        server::CompleteConfig(fleet.config).simulators_max(),
                    Seed(seed) + "more simulators than allowed");
  }
}

void Ghosts(const Setting& setting, Outcome* outcome) {
  for (int i = 0; i < setting.Many(4, 60); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    // The memory of what waits to be proved counts as that of agents.
    const Fleet fleet{.network = Faulty(seed), .seed = seed, .strangers = kStrangers};
    std::optional<Hostile> hostile;
    std::uint64_t simulators = 0, waits = 0;
    FlyAsPerfect(
        fleet,
        [&](Scene* scene) {
          hostile.emplace(seed + 5000, &scene->network());
          scene->When(kSecond, [&] { hostile->GoAsGhosts(); });
          scene->When(fleet.end_ns - kSecond, [&, scene] {
            simulators = static_cast<std::uint64_t>(scene->service().status().simulators_size());
            waits = scene->service().counter("unproven_inputs");
          });
        },
        outcome);
    outcome->Expect(simulators == 3, Seed(seed) + "ghosts became simulators");
    outcome->Add("hostile_messages", static_cast<double>(hostile->written()));
    outcome->Greatest("unproven_inputs", static_cast<double>(waits));
  }
  outcome->Expect(outcome->Get("unproven_inputs") > 100, "hardly a ghost came");
}

void HugeTerm(const Setting& setting, Outcome* outcome) {
  for (int i = 0; i < setting.Many(4, 60); ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    const Fleet fleet{.network = Faulty(seed), .seed = seed};
    const Fingerprint perfect = PerfectEvents(fleet);
    const auto scene = MakeScene(fleet);
    Hostile hostile(seed + 5000, &scene->network());
    Fly(
        fleet, scene.get(), [&] { scene->When(3 * kSecond, [&] { hostile.ClaimOnce(); }); },
        outcome);
    outcome->Expect(scene->service().runs(), Seed(seed) + "one sample has ended the service");
    Report(scene->Judged(), seed, outcome);
    const Fingerprint events{scene->service().events_hash(), scene->service().events_count()};
    outcome->Expect(events == perfect, Seed(seed) + "a forged status changed the events");
  }
}

}  // namespace

std::vector<Case> HostileCases() {
  const std::string promise =
      "no contact late or unheard, no promise covers one, brackets hold; all come to their end";
  return {
      {"hostile", "garbage", promise + "; no more simulators than allowed", Garbage,
       "a program writes 500 messages a second: numbers and times that are none, in the names "
       "of others, of their runs, slots and incarnations, and in ever new ones"},
      {"hostile", "ghosts", promise + "; the same events as without, and no other simulators",
       Ghosts,
       "a program writes 500 messages a second, a state each under ever-new ids that no name "
       "proves"},
      {"hostile", "huge-term", promise + "; the service goes on, with the same events as without",
       HugeTerm, "a status of the highest term there is, once"}};
}

}  // namespace collision::faults
