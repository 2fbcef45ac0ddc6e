#include "tests/faults/memory.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "client/library/network/conversion.h"
#include "client/library/network/revision_filter.h"
#include "collision/shape.h"
#include "collision_core/detection/pairs/pair_table.h"

namespace collision::faults {
namespace {

// Bytes, where agents are balls: two to four times what was measured, since a vector that grows
// is there twice for a moment. The sharp bound on growth is that of the cases of group memory.
constexpr std::size_t kService = 256 << 10;   ///< Its tables when they are empty.
constexpr std::size_t kSimulator = 32 << 10;  ///< In the service: clocks, refusals, clearances.
constexpr std::size_t kAgent = 8 << 10;       ///< In the service: states, a row in each table.
constexpr std::size_t kClient = 48 << 10;     ///< A World or a monitor without an agent.
constexpr std::size_t kOwnAgent = 4 << 10;    ///< In its World.
constexpr std::size_t kRemembered = 128;      ///< A pair that a client was told of.

/// An event that waits in a client until its program takes a step: the message of 336 bytes, and
/// ids, brackets and stamp of some 32 bytes each. Of each pair the newest waits (HeldForecasts),
/// and a service that comes back tells of all pairs at once. So there are no more than pairs at a
/// time, nor than pairs that the client was told of.
constexpr std::size_t kWaitingEvent = 512;

constexpr std::size_t kShapeByte = 64;  ///< Of a shape as it is sent: its trees, in a service.
constexpr std::size_t kWaitingSample = 2048;  ///< Taken from the network, and handed on.

/// What a scene consists of.
struct Size {
  std::size_t agents = 0;       ///< At a time.
  std::size_t pairs = 0;        ///< At a time.
  std::size_t simulators = 0;   ///< Names.
  std::size_t clients = 0;      ///< Worlds and monitors.
  std::size_t own_agents = 0;   ///< In all Worlds together, over the run.
  std::size_t told_pairs = 0;   ///< Likewise those that programs were told of.
  std::size_t waiting = 0;      ///< Events that may wait in all clients at a time.
  std::size_t shape_bytes = 0;  ///< Of all shapes together.
};

std::size_t AgentsAtATime(const Scene& scene) {
  std::map<std::int64_t, std::int64_t> changes;
  for (const SimulatorProgram* one : scene.simulators()) {
    for (const Flown& flown : one->flown()) {
      if (!flown.added_ns) continue;
      ++changes[*flown.added_ns];
      // Gone once all others have got there: they are at most two seconds behind.
      if (flown.removed_ns != client::kNever) --changes[flown.removed_ns + 2 * kSecond];
    }
  }
  std::int64_t now = 0, most = 0;
  for (const auto& [at_ns, change] : changes) most = std::max(most, now += change);
  return static_cast<std::size_t>(most);
}

using Pairs = std::set<std::pair<client::AgentId, client::AgentId>>;

/// A client more, which was told of these pairs.
void AddClient(const Pairs& told, Size* size) {
  ++size->clients;
  size->told_pairs += std::min(told.size(), 2 * client::RevisionFilter::kPairsMax);
  size->waiting += std::min(told.size(), size->pairs);
}

Size SizeOf(const Scene& scene, std::size_t strangers) {
  Size size;
  size.agents = AgentsAtATime(scene) + strangers;
  size.pairs =
      std::min<std::size_t>(size.agents * (size.agents - std::min<std::size_t>(1, size.agents)) / 2,
                            scene.config().pairs_max());
  std::set<std::string> names;
  std::set<const client::Shape*> shapes;
  for (const SimulatorProgram* one : scene.simulators()) {
    names.insert(one->options().name);
    size.own_agents += one->flown().size();
    for (const Flown& flown : one->flown()) {
      if (flown.flight.shape) shapes.insert(flown.flight.shape.get());
    }
    Pairs told;
    for (const HeardEvent& heard : one->heard())
      told.insert({heard.event.lower, heard.event.higher});
    AddClient(told, &size);
  }
  for (const client::Shape* shape : shapes) size.shape_bytes += shape->bytes().size();
  for (std::size_t i = 0; i < scene.monitors(); ++i) {
    Pairs told;
    for (const MonitoredEvent& heard : scene.monitor(i).heard()) {
      const client::Event event = client::FromMessage(heard.event);
      told.insert({event.lower, event.higher});
    }
    AddClient(told, &size);
  }
  size.simulators =
      std::min<std::size_t>(names.size() + strangers, scene.config().simulators_max());
  return size;
}

class MemoryJudge {
 public:
  MemoryJudge(const Scene& scene, const std::string& where, const Size& size,
              suite::Outcome* outcome)
      : scene_(scene), where_(where), size_(size), outcome_(*outcome) {}

  /// The tables of each service, by its own word.
  void JudgeTables() {
    for (std::size_t i = 0; i < scene_.services(); ++i) {
      for (const Published& published : scene_.service(i).published()) {
        if (published.output.has_service_status()) Judge(published.output.service_status());
      }
    }
  }

  void JudgeHeap() {
    const std::size_t waiting = kWaitingSample * scene_.network().counters().waiting_max;
    // Freed slots of pairs rest, so that their last samples stay readable.
    const std::size_t slots = std::min<std::size_t>(
        scene_.config().pairs_max(), size_.pairs + detection::PairTable::kSlotsResting);
    const std::size_t service = kService + kSimulator * size_.simulators + kAgent * size_.agents +
                                2 * sizeof(detection::PairRecord) * slots +
                                kShapeByte * size_.shape_bytes + waiting;
    const std::size_t clients = kClient * size_.clients + kOwnAgent * size_.own_agents +
                                kRemembered * size_.told_pairs + kWaitingEvent * size_.waiting +
                                waiting;
    JudgeOwner(Owner::kServices, "services", scene_.services() * service);
    JudgeOwner(Owner::kClients, "clients", clients);
  }

 private:
  void Judge(const v1::ServiceStatus& status) {
    Expect(status.agents(), size_.agents, "agents");
    Expect(status.pairs_tracked(), size_.pairs, "pairs");
    Expect(static_cast<std::size_t>(status.simulators_size()), size_.simulators, "simulators");
    for (const v1::Counter& counter : status.counters()) {
      if (counter.name() == "queued") Expect(counter.value(), size_.agents + size_.pairs, "queued");
    }
  }

  void JudgeOwner(Owner owner, const std::string& name, std::size_t allowed) {
    const auto peak = static_cast<std::size_t>(scene_.heap(owner).peak);
    outcome_.Greatest(name + "_heap", static_cast<double>(peak));
    outcome_.Greatest(name + "_heap_of_allowed",
                      static_cast<double>(peak) / static_cast<double>(allowed));
    Expect(peak, allowed, "bytes of the " + name);
  }

  void Expect(std::size_t is, std::size_t allowed, const std::string& what) {
    outcome_.Expect(is <= allowed, where_ + std::to_string(is) + " " + what + ", allowed are " +
                                       std::to_string(allowed));
  }

  const Scene& scene_;
  const std::string where_;
  const Size size_;
  suite::Outcome& outcome_;
};

}  // namespace

void ExpectBoundedMemory(const Scene& scene, std::uint64_t seed, std::size_t strangers,
                         suite::Outcome* outcome) {
  MemoryJudge judge(scene, "seed " + std::to_string(seed) + ": ", SizeOf(scene, strangers),
                    outcome);
  judge.JudgeTables();
  judge.JudgeHeap();
}

}  // namespace collision::faults
