// A network that loses, delays, doubles and reorders both ways, parts programs and joins them
// again: what DDS leaves open, in virtual time, from one seed.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <queue>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/faults/topics.h"
#include "tests/support/random.h"

namespace collision::faults {

inline constexpr std::int64_t kSecond = 1'000'000'000;
inline constexpr std::int64_t kMillisecond = 1'000'000;

struct NetworkOptions {
  std::uint64_t seed = 1;
  double loss = 0;       ///< Of a transmission; reliable writers send again.
  double duplicate = 0;  ///< Of samples to services, delivered again later, however old by then.
  std::int64_t delay_min_ns = 50'000;
  std::int64_t delay_max_ns = 500'000;
  std::int64_t resend_ns = 3'000'000;                ///< What a lost transmission costs.
  std::int64_t liveliness_lease_ns = 2 * kSecond;    ///< Silence that a reader of clocks notices.
  std::int64_t participant_lease_ns = 20 * kSecond;  ///< Then the other one is forgotten.
  Depths depths = DepthsOfProtocol();
};

enum class Role { kService, kSimulator, kMonitor };

struct NetworkCounters {
  std::uint64_t written = 0;      ///< Samples.
  std::uint64_t delivered = 0;    ///< Samples, to all readers.
  std::uint64_t lost = 0;         ///< Transmissions.
  std::uint64_t doubled = 0;      ///< Deliveries.
  std::uint64_t overwritten = 0;  ///< Samples that newer ones replaced before they arrived.
  std::uint64_t rematches = 0;    ///< Two programs found each other again after a lease had ended.
  std::size_t waiting_max = 0;    ///< Samples in a reader: the greatest number so far.
};

/// Programs join it; each writes, and takes what has arrived for it. Every (writer, topic) is
/// reliable, keep-last and, mostly, transient-local: a reader gets its samples in order, those that
/// a newer one replaced before they could be sent again excepted. A reader keeps the newest of each
/// instance, whichever writer they are from, and hands them on instance by instance: so samples of
/// one writer overtake each other where their instances differ. Two programs that have not heard of
/// each other for a participant's lease forget each other, and begin anew when they meet.
class Network {
 public:
  using Id = std::uint64_t;

  explicit Network(const NetworkOptions& options) : options_(options), random_(options.seed) {}

  std::int64_t now_ns() const { return now_ns_; }

  /// Runs `action` at a virtual time, not before now.
  void At(std::int64_t time_ns, std::function<void()> action);
  void After(std::int64_t delay_ns, std::function<void()> action) {
    At(now_ns_ + delay_ns, std::move(action));
  }

  /// Lets everything happen up to `until_ns`.
  void Run(std::int64_t until_ns);

  /// A new program. `arrived` is called when something has come for it. `simulator`: whose
  /// clearances and rejections it reads, for Role::kSimulator.
  Id Join(Role role, std::uint64_t simulator, std::function<void()> arrived);

  /// The program ends in good order: what it wrote arrives, and the others learn of its end.
  void Leave(Id id);

  /// It ends without a word: its samples go with it, its death is noticed after the lease.
  void Kill(Id id);

  void Write(Id id, const v1::Input& message);
  void Write(Id id, const v1::Output& message);

  /// This service hears also of the events that others publish.
  void ReadEvents(Id id) { programs_[id].reads_events = true; }

  /// What has arrived for a program, at most `limit`; either pointer may be null.
  void Take(Id id, std::size_t limit, std::vector<v1::Input>* inputs,
            std::vector<v1::Output>* outputs);
  bool HasArrivals(Id id) const;

  /// Whether a service is alive, as this program sees it.
  bool service_alive(Id id) const;

  /// Nothing gets from one to the other any more, or again.
  void Block(Id from, Id to);
  void Unblock(Id from, Id to);
  /// Between this program and all others that are there, both ways.
  void Isolate(Id id);
  void Rejoin(Id id);

  const NetworkCounters& counters() const { return counters_; }

 private:
  struct Occurrence {
    std::int64_t time_ns;
    std::uint64_t order;
    std::function<void()> action;
    bool operator<(const Occurrence& other) const {
      return std::tie(time_ns, order) > std::tie(other.time_ns, other.order);
    }
  };
  /// One of the two is set. `number` counts the samples of a writer.
  struct Sample {
    std::uint64_t number = 0;
    Address address;
    std::shared_ptr<const v1::Input> input;
    std::shared_ptr<const v1::Output> output;
  };
  struct Writer {
    std::uint64_t written = 0;
    std::map<std::string, std::deque<Sample>> history;
  };
  /// One topic of one writing program to one reading program.
  struct Line {
    std::int64_t last_arrival_ns = 0;
    std::uint64_t delivered = 0;  ///< The highest number.
    std::deque<Sample> held;      ///< It cannot arrive: the way is blocked.
    bool cut = false;  ///< What was lost will never be sent again, and the rest waits behind it.
  };
  struct Link {
    bool matched = false;
    std::uint64_t generation = 0;  ///< Of the match.
    std::map<Topic, Line> lines;
  };
  /// What a program knows of another one.
  struct Peer {
    bool known = false, alive = false, was_alive = false;
    std::uint64_t silence = 0;  ///< Counts the times that it fell silent, or spoke again.
  };
  struct Program {
    Role role = Role::kMonitor;
    std::uint64_t simulator = 0;
    std::optional<v1::Input> service;  ///< Its last status, as others hear of it.
    bool gone = false, reads_events = false;
    std::function<void()> arrived;
    std::map<Topic, Writer> writers;
    std::map<Id, Peer> peers;
    std::set<std::uint64_t> speaks_for;
    std::map<std::pair<Topic, std::string>, std::deque<Sample>> waiting;
    std::vector<v1::Input> changes;  ///< Of liveliness.
    std::size_t waits = 0;
  };

  bool Reads(const Program& reader, Topic topic) const;
  bool IsFor(const Program& reader, const Sample& sample) const;
  bool Stands(Id writer, const Sample& sample) const;
  void Write(Id id, Sample sample, bool disposes);
  void Transmit(Id writer, Id reader, const Sample& sample);
  void Release(Id writer, Id reader, Topic topic);
  void Arrive(Id writer, Id reader, const Sample& sample, std::uint64_t generation, bool lost);
  void Deliver(Id reader, const Sample& sample);
  void Hear(Id listener, Id other);
  void FallSilent(Id listener, Id other);
  void SetAlive(Id listener, Id other, bool alive);
  void Forget(Id listener, Id other);
  void Match(Id writer, Id reader);
  std::int64_t Delay();

  const NetworkOptions options_;
  Random random_;
  std::int64_t now_ns_ = 0;
  std::uint64_t order_ = 0;
  std::priority_queue<Occurrence> occurrences_;
  std::map<Id, Program> programs_;
  std::map<std::pair<Id, Id>, Link> links_;  ///< Writer, reader.
  std::set<std::pair<Id, Id>> blocked_;      ///< From, to.
  std::set<Id> isolated_;                    ///< Blocked from all, also from those that join later.
  NetworkCounters counters_;
};

}  // namespace collision::faults
