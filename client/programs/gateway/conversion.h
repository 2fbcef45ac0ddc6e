// Recordings of the service that somebody dropped onto the page.
#pragma once

#include <atomic>
#include <string>
#include <thread>

#include "client/programs/gateway/web/web_types.h"

namespace collision::gateway {

/// Makes MCAP files of recordings, one at a time, on a thread of its own. Any thread may call it,
/// one at a time.
class Conversion {
 public:
  Conversion() = default;
  /// Gives up what is under way.
  ~Conversion();
  Conversion(const Conversion&) = delete;
  Conversion& operator=(const Conversion&) = delete;

  /// Answers with the MCAP file, with 503 while another is being made, and with 422 and a sentence
  /// where the recording cannot be replayed.
  void Start(std::string recording, WebReply reply);

 private:
  void Run(const std::string& recording, const WebReply& reply);

  std::thread thread_;
  std::atomic<bool> is_busy_ = false, is_stopped_ = false;
};

}  // namespace collision::gateway
