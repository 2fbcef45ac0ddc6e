#include "client/programs/recordings/replayed_world.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "client/library/network/current_service.h"
#include "idl/recording/utc.h"

namespace collision::client {
namespace {

namespace fs = std::filesystem;

constexpr char kDaemon[] = "collisiond";

/// Beside this program, or where the shell would find it.
std::string DaemonPath() {
  std::error_code failed;
  std::vector<fs::path> folders = {fs::read_symlink("/proc/self/exe", failed).parent_path()};
  const char* path = std::getenv("PATH");
  std::string left = path == nullptr ? "" : path;
  while (!left.empty()) {
    const std::size_t end = std::min(left.find(':'), left.size());
    folders.emplace_back(left.substr(0, end));
    left.erase(0, end + 1);
  }
  for (const fs::path& folder : folders) {
    const std::string program = (folder / kDaemon).string();
    if (!folder.empty() && access(program.c_str(), X_OK) == 0) return program;
  }
  throw std::runtime_error(
      "collisiond is not beside this program, nor on the PATH: a recording holds what the service "
      "took in, and only the service tells what follows from it");
}

/// Throws std::runtime_error if there is no such file, or no collisiond.
std::vector<std::string> CommandOf(const ReplayRequest& request) {
  if (access(request.file.c_str(), R_OK) != 0) {
    throw std::runtime_error(request.file +
                             ": cannot be read: " + std::generic_category().message(errno));
  }
  std::vector<std::string> words = {DaemonPath(),   "--log-level", "error",
                                    "--transcript", "--replay",    request.file};
  const auto add = [&words](const char* option, const std::optional<std::int64_t>& time_ns) {
    if (time_ns) words.insert(words.end(), {option, wire::UtcText(*time_ns)});
  };
  add("--from", request.from_ns);
  add("--until", request.until_ns);
  return words;
}

}  // namespace

ReplayedWorld::ReplayedWorld(const ReplayRequest& request)
    : process_(CommandOf(request), request.niceness), entries_(process_.output_path()) {}

ReplayedWorld::~ReplayedWorld() = default;

bool ReplayedWorld::Begin() {
  if (!std::exchange(has_begun_, true)) is_over_ = !NextEntry();
  return !is_over_;
}

bool ReplayedWorld::NextEntry() { return entries_->Next(&entry_); }

void ReplayedWorld::Receive(std::chrono::nanoseconds, Arrivals* arrivals) {
  bool has_step = false;
  Begin();
  while (!is_over_) {
    if (entry_.has_batch()) {
      if (has_step) return;
      v1::RecordedBatch& batch = *entry_.mutable_batch();
      now_ = std::chrono::steady_clock::time_point(before_ +
                                                   std::chrono::nanoseconds(batch.monotonic_ns()));
      wall_ns_ = batch.wall_ns();
      for (v1::Input& input : *batch.mutable_inputs()) arrivals->inputs.push_back(std::move(input));
      has_step = !batch.continued();
    } else if (entry_.has_header()) {
      BeginRun(arrivals);
    } else if (entry_.has_told()) {
      // A hello has no stamp.
      const std::uint64_t service = StampOf(entry_.told().output()).service_id();
      if (service != 0) service_ = service;
      arrivals->outputs.push_back(std::move(*entry_.mutable_told()->mutable_output()));
    }
    is_over_ = !NextEntry();
  }
}

/// A start of the service: that of before is heard no more.
void ReplayedWorld::BeginRun(Arrivals* arrivals) {
  before_ = now_.time_since_epoch();
  if (service_ == 0) return;
  v1::ServiceHeard& former = *arrivals->inputs.emplace_back().mutable_service_heard();
  former.set_service_id(service_);
  former.set_ended(true);
}

int ReplayedWorld::Finish() {
  is_over_ = true;
  entries_.reset();
  return process_.Wait();
}

}  // namespace collision::client
