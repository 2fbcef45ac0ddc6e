// A recording of a service, played again, as a monitor would have heard it.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "client/library/network/transport.h"
#include "client/programs/recordings/replay_process.h"
#include "idl/recording.pb.h"
#include "idl/recording/entries.h"

namespace collision::client {

/// What is replayed, as `collisiond --replay` takes it.
struct ReplayRequest {
  std::string file;  ///< Recording, segment, or folder of segments.
  std::optional<std::int64_t> from_ns = {}, until_ns = {};  ///< Wall time.
  int niceness = 0;                                         ///< Of the replay, added to ours.
};

/// Lets collisiond replay a recording (beside this program, or on the path), and hands on what each
/// step took in and told. One thread.
class ReplayedWorld final : public Receiver {
 public:
  /// Does not wait for the replay. Throws std::runtime_error if there is no collisiond, or no such
  /// file.
  explicit ReplayedWorld(const ReplayRequest& request);
  /// Ends the replay.
  ~ReplayedWorld() override;
  ReplayedWorld(const ReplayedWorld&) = delete;
  ReplayedWorld& operator=(const ReplayedWorld&) = delete;

  /// One step; nothing at the end. Does not wait for `timeout`, but for the replay.
  void Receive(std::chrono::nanoseconds timeout, Arrivals* arrivals) override;
  /// The end of a recording is not the end of its service.
  bool service_alive() const override { return true; }
  /// The recorded monotonic time of the step.
  std::chrono::steady_clock::time_point Now() const override { return now_; }

  /// Waits until the replay has said something. False: it has nothing to say.
  bool Begin();

  /// Nothing is left, as far as was received.
  bool is_over() const { return is_over_; }

  /// The wall time of the step [ns since 1970].
  std::int64_t wall_ns() const { return wall_ns_; }

  /// Waits for the end of the replay. Returns its exit code, of which it has told the reason on
  /// standard error; to be called once, after which nothing is received.
  int Finish();

  /// Ends the replay: what is not received yet is lost. Any thread, while this lives.
  void Kill() { process_.Kill(); }

 private:
  bool NextEntry();
  void BeginRun(Arrivals* arrivals);

  ReplayProcess process_;
  std::optional<wire::EntryReader> entries_;
  v1::RecordingEntry entry_;  ///< The next one, unless it is over.
  std::chrono::steady_clock::time_point now_{};
  std::chrono::nanoseconds before_{0};  ///< Time of the starts of the service before this one.
  std::int64_t wall_ns_ = 0;
  std::uint64_t service_ = 0;  ///< That told the last message.
  bool has_begun_ = false, is_over_ = false;
};

}  // namespace collision::client
