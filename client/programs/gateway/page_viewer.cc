#include "client/programs/gateway/page_viewer.h"

namespace collision::gateway {

std::optional<WebMessage> PageViewer::Next() {
  if (unacknowledged_ == kUnacknowledgedMax) return std::nullopt;
  client::Board::News news = board_.After(seen_, kMessageBytes);
  if (news.items.empty()) return std::nullopt;
  seen_ = news.seen;
  ++unacknowledged_;
  WebMessage message;
  for (client::Board::Item& item : news.items) message.pieces.push_back(std::move(item.payload));
  return message;
}

std::string PageViewer::Hear(const std::string& message, bool is_text) {
  if (!is_text || message != "ack") return "a page says \"ack\" and nothing else";
  if (unacknowledged_ == 0) return "nothing is left to acknowledge";
  --unacknowledged_;
  return "";
}

}  // namespace collision::gateway
