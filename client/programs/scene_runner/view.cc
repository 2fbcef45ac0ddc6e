#include "client/programs/scene_runner/view.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>

#include "client/programs/shared/stop_signal.h"

namespace collision::client {
namespace {

constexpr std::chrono::seconds kStartMax{10};
constexpr std::chrono::milliseconds kLook{20};
constexpr std::size_t kLinesOfGateway = 12;

/// The address that the gateway prints once it listens.
std::string AddressIn(const std::string& log) {
  std::ifstream file(log);
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("http://")) return line;
  }
  return "";
}

std::string WaitForAddress(const std::string& log, ChildProcess* gateway) {
  const auto deadline = std::chrono::steady_clock::now() + kStartMax;
  while (std::chrono::steady_clock::now() < deadline && gateway->Running()) {
    if (std::string address = AddressIn(log); !address.empty()) return address;
    std::this_thread::sleep_for(kLook);
  }
  throw std::runtime_error("the gateway does not start:\n" + gateway->LastLines(kLinesOfGateway));
}

}  // namespace

RunResult ViewScene(RunnerOptions options, std::uint16_t port) {
  namespace fs = std::filesystem;
  options.world = options.scene + "-" + std::to_string(getpid());
  options.domain = options.domain.value_or(OwnDomain());
  options.unjudged = true;
  const bool is_paced = options.arguments.find("--speed") != std::string::npos;
  if (!options.real_time && !is_paced) options.arguments += " --speed 1";
  const fs::path program = fs::path(options.folders.bin) / "gateway";
  if (!fs::exists(program)) {
    throw std::runtime_error(program.string() + ": not built: it takes libboost-dev and npm");
  }
  UseLoopback(options.folders);
  const std::string log =
      (fs::temp_directory_path() / ("collision-gateway-" + std::to_string(getpid()))).string();
  ChildProcess gateway("collision-gateway",
                       {program.string(), "--world", options.world, "--domain",
                        std::to_string(*options.domain), "--port", std::to_string(port)},
                       log);
  std::printf("\n  look at it: %s\n  Ctrl-C ends it\n\n", WaitForAddress(log, &gateway).c_str());
  RunResult result = kSatisfied;
  while (!StopRequested() && result == kSatisfied && gateway.Running()) {
    result = Runner(options).Run();
  }
  if (!StopRequested() && !gateway.Running()) {
    throw std::runtime_error("the gateway has ended:\n" + gateway.LastLines(kLinesOfGateway));
  }
  std::error_code ignored;
  fs::remove(log, ignored);
  return result == kInterrupted ? kSatisfied : result;
}

}  // namespace collision::client
