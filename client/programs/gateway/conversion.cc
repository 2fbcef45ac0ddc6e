#include "client/programs/gateway/conversion.h"

#include <algorithm>
#include <filesystem>
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

constexpr int kNiceness = 10;  ///< What is live goes first.

WebResponse Refusal(int status, const std::string& why) {
  return {.status = status, .body = client::MakePayload(why + "\n")};
}

std::string ContentsOf(const std::string& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return std::move(bytes).str();
}

std::string NoteOn(const client::WorldRecorder& recorder, int code) {
  std::string note;
  if (recorder.files().size() > 1) {
    note = "the world's time begins anew in it: of " + std::to_string(recorder.files().size()) +
           " parts the largest is shown; collisionctl convert makes all";
  }
  if (code != 0) {
    note += std::string(note.empty() ? "" : "; ") + "it is damaged: what is whole is shown";
  }
  return note;
}

}  // namespace

void Conversion::Start(std::string recording, WebReply reply) {
  std::unique_lock lock(mutex_);
  if (is_busy_ || is_stopped_) {
    lock.unlock();
    return reply(Refusal(503, "another recording is being converted"));
  }
  if (thread_.joinable()) thread_.join();  // it has done its work
  thread_ = std::thread([this, recording = std::move(recording), reply = std::move(reply)] {
    WebResponse answer = Run(recording);
    {
      const std::lock_guard done(mutex_);
      is_busy_ = false;  // before the answer: who has it may send the next
    }
    reply(std::move(answer));
  });
  is_busy_ = true;
}

void Conversion::Stop() {
  std::unique_lock lock(mutex_);
  is_stopped_ = true;
  std::thread last = std::move(thread_);
  lock.unlock();
  changed_.notify_all();
  if (last.joinable()) last.join();
}

WebResponse Conversion::Run(const std::string& recording) {
  try {
    return Convert(recording);
  } catch (const std::exception& error) {
    return Refusal(422, error.what());
  }
}

/// While it lives, the replay is ended when it is late, or the gateway ends: it may be in a step
/// that takes for ever.
class Conversion::Watched {
 public:
  Watched(Conversion* conversion, client::ReplayedWorld* world)
      : conversion_(*conversion), thread_([this, world] { Watch(world); }) {}
  ~Watched() { End(); }
  Watched(const Watched&) = delete;
  Watched& operator=(const Watched&) = delete;

  bool was_killed() const {
    const std::lock_guard lock(conversion_.mutex_);
    return was_killed_;
  }

 private:
  void Watch(client::ReplayedWorld* world) {
    std::unique_lock lock(conversion_.mutex_);
    const auto is_over = [this] { return conversion_.is_stopped_ || is_over_; };
    const bool is_in_time = conversion_.changed_.wait_for(lock, kPatience, is_over);
    if (is_over_) return;
    was_killed_ = !is_in_time || conversion_.is_stopped_;
    world->Kill();
  }

  void End() {
    {
      const std::lock_guard lock(conversion_.mutex_);
      is_over_ = true;
    }
    conversion_.changed_.notify_all();
    thread_.join();
  }

  Conversion& conversion_;
  bool is_over_ = false, was_killed_ = false;  ///< Guarded by the conversion's mutex.
  std::thread thread_;
};

WebResponse Conversion::Convert(const std::string& recording) {
  const client::TemporaryFolder folder("collision-gateway");
  const std::string input = folder.Path("dropped.rec"), output = folder.Path("dropped.mcap");
  if (!(std::ofstream(input, std::ios::binary) << recording).flush()) {
    throw std::runtime_error(input + ": cannot be written");
  }
  auto replayed = std::make_unique<client::ReplayedWorld>(
      client::ReplayRequest{.file = input, .niceness = kNiceness});
  client::ReplayedWorld& world = *replayed;
  client::WorldRecorder recorder(std::move(replayed),
                                 {.path = output, .wall_ns = [&world] { return world.wall_ns(); }});
  {
    const Watched watched(this, &world);
    while (!world.is_over()) {
      recorder.Poll({});
      if (recorder.bytes() > kResultBytesMax) {
        throw std::runtime_error("what comes of it is too large: use collisionctl convert");
      }
    }
    recorder.Close();
    if (watched.was_killed()) {
      throw std::runtime_error(
          "it takes longer than five minutes, or the gateway ends: use collisionctl convert");
    }
  }
  const int code = world.Finish();
  if (!recorder.view().status()) {
    throw std::runtime_error("collisiond cannot replay it (exit code " + std::to_string(code) +
                             "): is it a recording of this version?");
  }
  const auto largest =
      std::ranges::max_element(recorder.files(), {}, [](const auto& file) { return file.second; });
  WebResponse answer{.type = "application/octet-stream",
                     .body = client::MakePayload(ContentsOf(largest->first))};
  if (const std::string note = NoteOn(recorder, code); !note.empty()) {
    answer.headers.emplace_back(kNoteHeader, note);
  }
  return answer;
}

}  // namespace collision::gateway
