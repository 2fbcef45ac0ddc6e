// Recordings of the service that somebody dropped onto the page.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

#include "client/programs/gateway/web/web_types.h"

namespace collision::gateway {

/// Makes MCAP files of recordings, one at a time, on a thread of its own. Any thread may call it.
class Conversion {
 public:
  static constexpr std::chrono::minutes kPatience{5};           ///< With one of them.
  static constexpr std::uintmax_t kResultBytesMax = 512 << 20;  ///< Of what is made.

  Conversion() = default;
  ~Conversion() { Stop(); }
  Conversion(const Conversion&) = delete;
  Conversion& operator=(const Conversion&) = delete;

  /// Answers with the MCAP file, with 503 while another is being made or after Stop(), and with 422
  /// and a sentence where the recording cannot be replayed. Of a world whose time begins anew in it
  /// the largest part is made; the header kNoteHeader says so.
  void Start(std::string recording, WebReply reply);

  /// Gives up what is under way, and takes no more.
  void Stop();

  static constexpr char kNoteHeader[] = "X-Collision-Note";

 private:
  class Watched;

  WebResponse Run(const std::string& recording);
  WebResponse Convert(const std::string& recording);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::thread thread_;  ///< Guarded by it, as all below.
  bool is_busy_ = false, is_stopped_ = false;
};

}  // namespace collision::gateway
