// A network, its time and its faults, from one seed.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <queue>
#include <string>
#include <tuple>
#include <vector>

#include "server/bus/bus.h"
#include "server/bus/clock.h"
#include "tests/support/random.h"

namespace collision::server {

struct NetworkOptions {
  std::uint64_t seed = 1;
  double loss = 0;       ///< Of a transmission; reliable writers send again.
  double duplicate = 0;  ///< Delivered again later, however old it is by then.
  std::int64_t delay_min_ns = 50'000;
  std::int64_t delay_max_ns = 500'000;
  std::int64_t resend_ns = 3'000'000;     ///< What a lost transmission costs.
  std::int64_t lease_ns = 1'000'000'000;  ///< Until a dead writer is noticed.
};

/// What the promises of DDS leave open, happens: reliable, transient-local, keep-last-1 writers.
/// Each keeps its own order; samples of different writers overtake each other; what is overwritten
/// before it was sent again never arrives. Time is virtual: it jumps from one occurrence to the
/// next.
class SimulatedNetwork {
 public:
  explicit SimulatedNetwork(const NetworkOptions& options);

  std::int64_t now_ns() const { return now_ns_; }

  /// Runs `action` at a virtual time, not before now.
  void At(std::int64_t time_ns, std::function<void()> action);

  /// A simulator's program writes. The topic and the instance follow from the message.
  void Write(std::uint64_t sender, const v1::Input& message);

  /// The program ends without a word: its samples go with it, its death is noticed after the lease.
  void Kill(std::uint64_t sender, std::uint64_t simulator_id);

  /// Hands every output on, after a delay, in the service's order. Keep-last-1: none is lost here,
  /// so that the test sees everything; simulators must cope with late ones.
  void Subscribe(std::function<void(const v1::Output&)> handler);

  // ---- the service's side ----

  /// Connects a service: everything the living writers hold is delivered to it.
  /// `reader` also learns whether a sample is a late duplicate.
  void Attach(std::function<void(const v1::Input&, bool duplicate)> reader);
  void Detach() { reader_ = nullptr; }

  void PublishToAll(const v1::Output& output);

  /// Lets the next thing happen if it lies not after `deadline_ns`; false: there is none.
  bool RunOne(std::int64_t deadline_ns);
  bool idle() const { return occurrences_.empty(); }
  void SkipTo(std::int64_t time_ns) { now_ns_ = std::max(now_ns_, time_ns); }

 private:
  struct Occurrence {
    std::int64_t time_ns;
    std::uint64_t order;
    std::function<void()> action;
    bool operator<(const Occurrence& other) const {
      return std::tie(time_ns, order) > std::tie(other.time_ns, other.order);
    }
  };
  struct Sample {
    std::uint64_t version = 0;
    v1::Input message;
    bool present = false;
  };
  struct Writer {
    std::int64_t last_arrival_ns = 0;
    std::map<std::string, Sample> history;
  };
  using WriterKey = std::pair<std::uint64_t, int>;  ///< Sender, topic.

  void Transmit(const WriterKey& key, const std::string& instance, const v1::Input& message,
                std::uint64_t version);
  void Deliver(const v1::Input& message, bool duplicate) {
    if (reader_) reader_(message, duplicate);
  }
  std::int64_t Delay(Random* random);

  const NetworkOptions options_;
  Random random_;
  Random random_of_reports_;  ///< Of its own: reports do not change when all else arrives.
  std::int64_t now_ns_ = 0;
  std::uint64_t order_ = 0;
  std::uint64_t version_ = 0;
  std::int64_t last_output_ns_ = 0;
  std::int64_t last_report_ns_ = 0;
  std::priority_queue<Occurrence> occurrences_;
  std::map<WriterKey, Writer> writers_;
  std::vector<std::function<void(const v1::Output&)>> handlers_;
  std::function<void(const v1::Input&, bool)> reader_;
};

/// The service's end of the network. Several samples of one instance that wait for Receive()
/// collapse to the newest, as a keep-last-1 reader does it.
class SimulatedBus final : public Bus {
 public:
  explicit SimulatedBus(SimulatedNetwork* network);
  ~SimulatedBus() override { network_.Detach(); }

  /// False once nothing is left that could ever happen.
  bool Receive(std::chrono::nanoseconds timeout, std::size_t limit,
               std::vector<v1::Input>* inputs) override;
  void Publish(const v1::Output& output) override;
  void Flush() override {}
  void Wake() override {}

  /// Everything published on this bus, in order.
  const std::vector<v1::Output>& published() const { return published_; }

 private:
  void Take(const v1::Input& message, bool duplicate);

  SimulatedNetwork& network_;
  std::deque<v1::Input> inbox_;
  std::vector<v1::Output> published_;
};

/// Virtual time as the daemon reads it.
class SimulatedClock final : public Clock {
 public:
  explicit SimulatedClock(const SimulatedNetwork* network) : network_(*network) {}
  ClockReading Read() override {
    return {.wall_ns = kWallAtStart + network_.now_ns(), .monotonic_ns = network_.now_ns()};
  }
  static constexpr std::int64_t kWallAtStart = 1'700'000'000'000'000'000;

 private:
  const SimulatedNetwork& network_;
};

}  // namespace collision::server
