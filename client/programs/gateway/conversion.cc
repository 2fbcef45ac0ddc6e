#include "client/programs/gateway/conversion.h"

#include <chrono>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "client/programs/recordings/replayed_world.h"
#include "client/programs/recordings/temporary_folder.h"
#include "client/programs/recordings/world_recorder.h"

namespace collision::gateway {
namespace {

constexpr std::chrono::minutes kPatience{5};

std::string Converted(const std::string& recording, const std::atomic<bool>& is_stopped) {
  const client::TemporaryFolder folder("collision-gateway");
  const std::string input = folder.Path("dropped.rec"), output = folder.Path("dropped.mcap");
  if (!(std::ofstream(input, std::ios::binary) << recording).flush()) {
    throw std::runtime_error(input + ": cannot be written");
  }
  auto replayed = std::make_unique<client::ReplayedWorld>(
      client::ReplayRequest{.file = input, .from_ns = {}, .until_ns = {}});
  client::ReplayedWorld& world = *replayed;
  client::WorldRecorder recorder(std::move(replayed),
                                 {.path = output, .wall_ns = [&world] { return world.wall_ns(); }});
  const auto begin = std::chrono::steady_clock::now();
  while (!world.is_over()) {
    if (is_stopped) throw std::runtime_error("the gateway ends");
    if (std::chrono::steady_clock::now() - begin > kPatience) {
      throw std::runtime_error("it takes longer than five minutes: use collisionctl convert");
    }
    recorder.Poll({});
  }
  recorder.Close();
  const int code = world.Finish();
  if (!recorder.view().status()) {
    throw std::runtime_error("collisiond cannot replay it (exit code " + std::to_string(code) +
                             "): is it a recording of this version?");
  }
  std::ostringstream bytes;
  bytes << std::ifstream(output, std::ios::binary).rdbuf();
  return std::move(bytes).str();
}

}  // namespace

Conversion::~Conversion() {
  is_stopped_ = true;
  if (thread_.joinable()) thread_.join();
}

void Conversion::Start(std::string recording, WebReply reply) {
  if (is_busy_.exchange(true)) {
    return reply(
        {.status = 503, .body = client::MakePayload("another recording is being converted\n")});
  }
  if (thread_.joinable()) thread_.join();
  thread_ = std::thread([this, recording = std::move(recording), reply = std::move(reply)] {
    Run(recording, reply);
    is_busy_ = false;
  });
}

void Conversion::Run(const std::string& recording, const WebReply& reply) {
  try {
    reply({.type = "application/octet-stream",
           .body = client::MakePayload(Converted(recording, is_stopped_))});
  } catch (const std::exception& error) {
    reply({.status = 422, .body = client::MakePayload(std::string(error.what()) + "\n")});
  }
}

}  // namespace collision::gateway
