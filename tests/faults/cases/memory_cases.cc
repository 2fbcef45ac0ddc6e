// Long runs: what programs keep does not grow with time.
//
// A run is flown in laps, each as the first one, with all that a program may have to remember for a
// while: jumps, changed descriptions, agents that come and go, programs that come and go, under
// ever-new names or with ever-higher runs. So lap for lap the heap of services and clients must be
// the same. One table of a client fills up over more laps than any run has: it remembers the pairs
// of which it was told (RevisionFilter::kPairsMax). The test knows how many these are, and takes
// off what they cost.
#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "client/library/network/conversion.h"
#include "server/config/config.h"
#include "tests/faults/cases/cases.h"
#include "tests/faults/cases/fleet.h"

namespace collision::faults {
namespace {

constexpr std::int64_t kLap = 10 * kSecond;

/// What a client remembers of a pair: a node of RevisionFilter's map, with the name of no level.
constexpr std::int64_t kRememberedPair = 192;

/// What a World remembers of an agent: a node of AgentNames' map, with a short name.
constexpr std::int64_t kRememberedName = 96;

/// Laps from `first` up to, not including, `end`. The way back to the beginning of one is a jump.
Motion InLaps(const Motion& lap, int first, int end) {
  Motion motion;
  for (int i = first; i < end; ++i) {
    const std::int64_t shift = i * kLap;
    if (i > first) motion.jumps_ns.push_back(shift);
    for (server::Piece piece : lap.pieces) {
      if (piece.start_ns >= kLap) break;
      piece.start_ns += shift;
      piece.end_ns = std::min(piece.end_ns, kLap) + shift;
      motion.pieces.push_back(piece);
    }
    for (const std::int64_t jump : lap.jumps_ns) {
      if (0 < jump && jump < kLap) motion.jumps_ns.push_back(jump + shift);
    }
  }
  return motion;
}

/// An agent that jumps and is described anew.
Flight Flier(const Motion& lap, int first, int end) {
  Flight flight{.motion = InLaps(lap, first, end), .acceleration_max = 4};
  for (int i = first; i < end; ++i) {
    flight.changes.push_back({i * kLap + 2 * kSecond, 12});
    flight.changes.push_back({i * kLap + 4 * kSecond, 6});
    flight.changes.push_back({i * kLap + 7 * kSecond, 4});
  }
  return flight;
}

/// Every second one is another agent in every lap.
std::vector<Flight> Fliers(int count, int first, int end, Random* random) {
  const server::WanderOptions options{.half_side = 12,
                                      .speed = 9,
                                      .acceleration_max = 4,
                                      .jumps_per_piece = 0.7,
                                      .piece_min_ns = 100 * kMillisecond,
                                      .piece_max_ns = 500 * kMillisecond};
  std::vector<Flight> flights;
  for (int i = 0; i < count; ++i) {
    const Motion lap = server::Wander(options, kLap, random);
    if (i % 2 == 0) {
      flights.push_back(Flier(lap, first, end));
      continue;
    }
    for (int one = first; one < end; ++one) {
      Flight& flight = flights.emplace_back(Flier(lap, one, one + 1));
      flight.from_ns = one * kLap + kSecond;
      flight.until_ns = one * kLap + 8 * kSecond;
    }
  }
  return flights;
}

struct Tour {
  bool lock_step = true;
  bool visitors = false;  ///< Programs that come and go, one each lap.
  int laps = 8;
};

/// Two tables fill up over many laps, up to these: slots of pairs rest before they are used again,
/// and a simulator that has left is remembered until another one needs its place.
v1::Config ConfigOf(const Tour& tour) {
  v1::Config config = tour.lock_step ? LockStepConfig(3) : WallConfig(0.02);
  config.set_pairs_max(256);
  config.set_simulators_max(6);
  return config;
}

/// One run in laps, and the mean heap in each.
class Laps {
 public:
  Laps(const Tour& tour, std::uint64_t seed)
      : tour_(tour),
        random_(seed),
        scene_(ConfigOf(tour), Faulty(seed)),
        sums_(static_cast<std::size_t>(tour.laps)) {
    scene_.AddService();
    scene_.AddMonitor();
    const std::array<const char*, 3> names = {"alpha", "beta", "gamma"};
    for (std::size_t i = 0; i < names.size(); ++i) {
      scene_.AddSimulator({.name = names[i],
                           .lock_step = tour.lock_step,
                           .incarnation = static_cast<std::uint32_t>(i + 1),
                           .period_ns = static_cast<std::int64_t>(50 << i) * kMillisecond,
                           .end_ns = tour.laps * kLap,
                           .on_demand = i < 2},
                          Fliers(4, 0, tour.laps, &random_));
    }
  }

  void Fly(std::uint64_t seed, Outcome* outcome) {
    scene_.StartAll();
    Sample();
    const bool ended = scene_.RunToEnd(tour_.laps * 10 * kLap);
    outcome->Expect(ended, "seed " + std::to_string(seed) + ": the run came to no end");
    ReportProgress(scene_, seed, outcome);
  }

  /// From lap `first` up to, not including, `end`.
  double Mean(Owner owner, int first, int end) const {
    double mean = 0;
    for (int lap = first; lap < end; ++lap) {
      const Sum& sum = sums_[static_cast<std::size_t>(lap)];
      mean += static_cast<double>(sum.bytes[static_cast<std::size_t>(owner)]) /
              static_cast<double>(sum.samples) / (end - first);
    }
    return mean;
  }

 private:
  struct Sum {
    std::array<std::int64_t, kOwners> bytes{};
    std::int64_t samples = 0;
  };

  void Sample() {
    // One that joins has not reached anything yet.
    const std::int64_t reached = std::max<std::int64_t>(scene_.reached_ns(), 0);
    const std::size_t lap = std::max(lap_, static_cast<std::size_t>(reached / kLap));
    if (lap >= sums_.size()) return;
    if (lap > lap_) {
      ++lap_;
      BeginLap();
    }
    Sum& sum = sums_[lap];
    ++sum.samples;
    sum.bytes[1] += scene_.heap(Owner::kServices).live;
    sum.bytes[2] += scene_.heap(Owner::kClients).live - Remembered();
    scene_.network().After(10 * kMillisecond, [this] { Sample(); });
  }

  void BeginLap() {
    if (!tour_.visitors) return;
    // One of a new name that ends in good order, and one that is killed and comes back.
    const std::int64_t now = static_cast<std::int64_t>(lap_) * kLap;
    Visit("visitor-" + std::to_string(lap_), now + 6 * kSecond);
    if (killed_ != nullptr) killed_->Kill();
    killed_ = &Visit("restarted", kLap * tour_.laps);
  }

  SimulatorProgram& Visit(const std::string& name, std::int64_t end_ns) {
    const auto number = static_cast<std::uint32_t>(lap_ + 10);
    const auto lap = static_cast<int>(lap_);
    Random random(7);
    SimulatorProgram& visitor = scene_.AddSimulator({.name = name,
                                                     .lock_step = tour_.lock_step,
                                                     .run = number,
                                                     .incarnation = number,
                                                     .end_ns = end_ns,
                                                     .joins = tour_.lock_step},
                                                    Fliers(2, lap, lap + 2, &random));
    visitor.Start();
    return visitor;
  }

  /// Bytes for the pairs of which the programs that live were told, and for names.
  std::int64_t Remembered() {
    std::int64_t pairs = 0, names = 0;
    const auto simulators = scene_.simulators();
    told_.resize(simulators.size() + 1);
    Told& monitor = told_[0];
    const auto& events = scene_.monitor().heard();
    for (; monitor.heard < events.size(); ++monitor.heard) {
      monitor.pairs.insert(PairOf(client::FromMessage(events[monitor.heard].event)));
    }
    pairs += std::ssize(monitor.pairs);
    for (std::size_t i = 0; i < simulators.size(); ++i) {
      Told& told = told_[i + 1];
      const auto& heard = simulators[i]->heard();
      for (; told.heard < heard.size(); ++told.heard) {
        const client::Event& event = heard[told.heard].event;
        told.pairs.insert(PairOf(event));
        told.agents.insert({event.lower, event.higher});
      }
      for (const Flown& own : simulators[i]->flown()) {
        if (own.added_ns) told.agents.insert(own.id);
      }
      if (!simulators[i]->connected()) continue;
      pairs += std::ssize(told.pairs);
      names += std::ssize(told.agents);
    }
    return kRememberedPair * pairs + kRememberedName * names;
  }

  using Pair = std::pair<client::AgentId, client::AgentId>;
  static Pair PairOf(const client::Event& event) { return {event.lower, event.higher}; }

  struct Told {
    std::size_t heard = 0;
    std::set<Pair> pairs;
    std::set<client::AgentId> agents;
  };

  const Tour tour_;
  Random random_;
  Scene scene_;
  std::vector<Sum> sums_;
  std::vector<Told> told_;  ///< The monitor, then each simulator.
  std::size_t lap_ = 0;
  SimulatorProgram* killed_ = nullptr;
};

/// What may be more in a later lap: capacities of vectors and deques, and what happens to wait.
/// After a rare peak the list of events of one step takes 31 kB instead of 15 kB, and histories of
/// six agents 6 kB more.
constexpr std::array<double, kOwners> kTolerance = {0, 36864, 4096};

/// In the second eighth of the run all tables are filled. What is kept after that is held against
/// the quarter and the half of the run that follow.
void Growth(const Tour& tour, int runs, Outcome* outcome) {
  for (int i = 0; i < runs; ++i) {
    const auto seed = static_cast<std::uint64_t>(i + 1);
    Laps laps(tour, seed);
    laps.Fly(seed, outcome);
    if (!kHeapIsCounted) continue;
    for (const Owner owner : {Owner::kServices, Owner::kClients}) {
      const bool service = owner == Owner::kServices;
      const double first = laps.Mean(owner, tour.laps / 8, tour.laps / 4);
      outcome->Greatest(service ? "services_bytes" : "clients_bytes", first);
      for (const int part : {4, 2}) {
        const double grown = laps.Mean(owner, tour.laps / part, 2 * tour.laps / part) - first;
        outcome->Greatest(service ? "services_grown" : "clients_grown", grown);
        outcome->Expect(
            grown <= kTolerance[static_cast<std::size_t>(owner)],
            "seed " + std::to_string(seed) + ": from lap " + std::to_string(tour.laps / part) +
                " on " + (service ? "the service has " : "the clients have ") + suite::Show(grown) +
                " bytes more than in lap " + std::to_string(tour.laps / 8));
      }
    }
  }
}

void LockStep(const Setting& setting, Outcome* outcome) {
  Growth({.laps = setting.Many(32, 128)}, setting.Many(1, 4), outcome);
}
void WallClock(const Setting& setting, Outcome* outcome) {
  Growth({.lock_step = false, .laps = setting.Many(16, 128)}, setting.Many(1, 2), outcome);
}
void Visitors(const Setting& setting, Outcome* outcome) {
  Growth({.visitors = true, .laps = setting.Many(32, 64)}, setting.Many(1, 4), outcome);
}

}  // namespace

std::vector<Case> MemoryCases() {
  const std::string promise =
      "from then on neither the service nor the clients have more bytes than in the second eighth "
      "of the run, but for capacities (36 and 4 KiB)";
  return {{"memory", "lock-step", promise, LockStep,
           "a tenth of all transmissions lost and of samples doubled, up to 5 ms of delay; laps of "
           "10 s, each like the first, in which 12 agents jump and are described anew, and half of "
           "them are other ones"},
          {"memory", "wall-clock", promise, WallClock, "the same on the wall clock"},
          {"memory", "visitors", promise, Visitors,
           "the same in lock-step, and in each lap a program of a new name comes and goes, and "
           "another one is killed and comes back with its next run"}};
}

}  // namespace collision::faults
