// A viewer that opened the gateway's page.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "client/programs/gateway/web/web_types.h"
#include "client/programs/scene/board.h"

namespace collision::gateway {

/// The sub-protocol of the page.
inline constexpr char kPageProtocol[] = "collision.page.v1";

/// Sends the items that are new to this viewer, several in a message. The page says "ack" for each
/// message that it has shown; while two are not acknowledged nothing is sent, so that what a
/// stopped browser sees when it goes on is at most two messages old.
class PageViewer final : public WebViewer {
 public:
  static constexpr int kUnacknowledgedMax = 2;
  static constexpr std::size_t kMessageBytes = 4 << 20;  ///< About; an item is sent whole.

  /// `board` outlives it.
  explicit PageViewer(const client::Board* board) : board_(*board) {}

  std::optional<WebMessage> Next() override;
  std::string Hear(const std::string& message, bool is_text) override;

 private:
  const client::Board& board_;
  std::uint64_t seen_ = 0;
  int unacknowledged_ = 0;
};

}  // namespace collision::gateway
