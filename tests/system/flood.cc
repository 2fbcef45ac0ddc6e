// A hostile simulator, and an honest one beside it that measures how fast it is answered.
//
//   flood keys COUNT        writes states under COUNT keys that are all new
//   flood disposals COUNT   disposes of COUNT keys that were never written
//   flood answers SECONDS   steps two agents that touch, in lock-step; prints for all its steps how
//                           long it waited for the answer [ms]: median, 99 of 100, the longest
//
// After these words: WORLD DOMAIN.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include "collision/world.h"
#include "idl/dds/session.h"

namespace collision::system_test {
namespace {

using std::chrono::steady_clock;

constexpr std::uint32_t kAtATime = 1000;  // samples between two calls that send them

void WriteKeys(DdsSession* session, std::uint32_t count) {
  v1::AgentStates states;
  states.set_run(1);
  states.add_states()->mutable_orientation()->set_w(1);
  for (std::uint32_t key = 0; key < count; ++key) {
    states.set_simulator_id(1 + key / 65536);
    states.set_chunk(key % 65536);
    states.set_incarnation(key);
    session->Write(states);
    if (key % kAtATime == 0) session->Flush();
  }
  session->Flush();
}

void DisposeOfKeys(DdsSession* session, std::uint32_t count) {
  for (std::uint32_t shape = 0; shape < count / kAtATime; ++shape) {
    session->RemoveShape(1, shape, kAtATime);
    session->Flush();
  }
}

void Flood(const std::string& what, std::uint32_t count, const DdsSessionOptions& options) {
  DdsSession session(options);
  std::vector<v1::Output> outputs;
  while (outputs.empty()) {
    session.Receive(std::chrono::milliseconds(20), kAtATime, nullptr, &outputs);
  }
  const auto begin = steady_clock::now();
  what == "keys" ? WriteKeys(&session, count) : DisposeOfKeys(&session, count);
  const std::chrono::duration<double> took = steady_clock::now() - begin;
  std::printf("written: %u in %.1f s\n", count, took.count());
  std::fflush(stdout);
}

/// In steps of a frame: the agents touch, so that no more than that is granted.
void MeasureAnswers(double seconds, const std::string& name, std::uint32_t domain) {
  constexpr std::int64_t kStep = 16'666'667;
  client::World world =
      client::World::Connect({.world = name, .simulator = "honest", .domain = domain});
  client::Agent one =
      world.AddAgent({.name = "one", .radius_m = 1, .acceleration_max_m_s2 = 1}, {});
  client::Agent two =
      world.AddAgent({.name = "two", .radius_m = 1, .acceleration_max_m_s2 = 1}, {});
  std::vector<double> waits_ms;
  const auto begin = steady_clock::now();
  const auto end = begin + std::chrono::duration_cast<steady_clock::duration>(
                               std::chrono::duration<double>(seconds));
  for (std::int64_t t = 0; steady_clock::now() < end; t += kStep) {
    one.SetState({.stamp_ns = t, .position_m = {0, 0, 0}});
    two.SetState({.stamp_ns = t, .position_m = {1, 0, 0}});
    const auto before = steady_clock::now();
    if (world.AdvanceTo(t, std::chrono::seconds(60)) == client::Advance::kTimeout) break;
    const std::chrono::duration<double, std::milli> waited = steady_clock::now() - before;
    waits_ms.push_back(waited.count());
    if (waits_ms.size() == 1) {
      std::printf("steps\n");
      std::fflush(stdout);
    }
  }
  std::sort(waits_ms.begin(), waits_ms.end());
  const auto at = [&](double part) {
    return waits_ms[static_cast<std::size_t>(part * static_cast<double>(waits_ms.size() - 1))];
  };
  std::printf("answers: %zu, ms: %.3f %.3f %.3f\n", waits_ms.size(), at(0.5), at(0.99), at(1));
}

int Run(const std::vector<std::string>& words) {
  const std::string& what = words.at(0);
  const std::string& world = words.at(2);
  const auto domain = static_cast<std::uint32_t>(std::stoul(words.at(3)));
  if (what == "answers") {
    MeasureAnswers(std::stod(words.at(1)), world, domain);
    return 0;
  }
  DdsSessionOptions options;
  options.world = world;
  options.domain = domain;
  options.role = DdsRole::kSimulator;
  options.simulator = "hostile";
  Flood(what, static_cast<std::uint32_t>(std::stoul(words.at(1))), options);
  return 0;
}

}  // namespace
}  // namespace collision::system_test

int main(int count, char** words) {
  if (count != 5) {
    std::fprintf(stderr, "usage: flood keys|disposals|answers COUNT|SECONDS WORLD DOMAIN\n");
    return 2;
  }
  return collision::system_test::Run({words + 1, words + count});
}
