// A participant that writes what no simulator would: messages of every topic, for several names,
// with fields that are spoilt at random (tests/fuzz/fuzzed_messages.h).
//
//   hostile COUNT WORLD DOMAIN    says "written: COUNT" on standard output, and ends
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "idl/dds/session.h"
#include "tests/fuzz/fuzzed_messages.h"
#include "tests/support/random.h"

namespace collision::system_test {
namespace {

constexpr int kAtATime = 50;                // messages between two calls that send them
constexpr std::size_t kBytesOfInput = 512;  // as much as a message draws from, mostly

void Write(const v1::Input& input, DdsSession* session) {
  switch (input.message_case()) {
    case v1::Input::kAgentDescription:
      return session->Write(input.agent_description());
    case v1::Input::kAgentStates:
      return session->Write(input.agent_states());
    case v1::Input::kSimulatorClock:
      return session->Write(input.simulator_clock());
    case v1::Input::kShapePart:
      return session->Write(input.shape_part());
    case v1::Input::kAgentRemoval:
      return session->RemoveAgent(input.agent_removal());
    case v1::Input::kShapeRemoval:
      return session->RemoveShape(input.shape_removal().simulator_id(),
                                  input.shape_removal().shape(), 2);
    default:
      return;
  }
}

std::int64_t WallNs() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

void Spoil(int count, const DdsSessionOptions& options) {
  DdsSession session(options);
  Random random(1);
  std::vector<v1::Output> outputs;
  while (outputs.empty()) session.Receive(std::chrono::milliseconds(20), 100, nullptr, &outputs);
  for (int written = 0; written < count; ++written) {
    std::vector<std::uint8_t> bytes(kBytesOfInput);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.Next());
    fuzz::FuzzedData data(bytes);
    v1::Input input = fuzz::FuzzedInput(WallNs(), &data);
    if (fuzz::ThroughNetwork(&input)) Write(input, &session);
    if (written % kAtATime != 0) continue;
    session.Flush();
    session.Receive(std::chrono::milliseconds(1), 1000, nullptr, &outputs);
    outputs.clear();
  }
  session.Flush();
  std::printf("written: %d\n", count);
}

}  // namespace
}  // namespace collision::system_test

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  collision::DdsSessionOptions options;
  options.world = argv[2];
  options.domain = static_cast<std::uint32_t>(std::stoul(argv[3]));
  options.role = collision::DdsRole::kSimulator;
  options.simulator = "hostile";
  collision::system_test::Spoil(std::stoi(argv[1]), options);
}
