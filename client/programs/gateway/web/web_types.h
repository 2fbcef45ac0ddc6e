// What a web server and its program exchange: plain values, nothing of a library.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "client/programs/scene/payload.h"

namespace collision::gateway {

using client::MakePayload;
using client::Payload;

/// A request by GET or HEAD, or by POST with its body.
struct WebRequest {
  std::string method;
  std::string path;   ///< Decoded: "/shapes/1f.bin".
  std::string query;  ///< Behind the "?", as it was sent.
  bool takes_gzip = false;
  std::string body = {};
};

struct WebResponse {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  Payload body = nullptr;
  /// Further headers, name and value.
  std::vector<std::pair<std::string, std::string>> headers = {};
};

/// A WebSocket message as the pieces that follow each other in it.
struct WebMessage {
  bool is_text = false;
  std::vector<Payload> pieces;
};

/// The other end of one WebSocket, called on the server's thread alone.
class WebViewer {
 public:
  virtual ~WebViewer() = default;

  /// The message to be sent next; nullopt: none at the moment. Called when the one before has left,
  /// after each message that came, and after WebServer::Wake(). So nothing waits in a queue: a
  /// viewer that reads slowly is asked rarely, and gets what is newest then.
  virtual std::optional<WebMessage> Next() = 0;

  /// A message has come. Returns why the connection ends, in a sentence; empty: it goes on.
  virtual std::string Hear(const std::string& message, bool is_text) = 0;
};

/// A request whose answer takes long: `reply` may be called later, once, and from any thread.
using WebReply = std::function<void(WebResponse)>;

/// What the program does with what comes; each is called on the server's thread alone.
struct WebHandlers {
  std::function<WebResponse(const WebRequest& request)> answer;
  /// POST to this path may bring WebOptions::upload_bytes_max; empty: to none.
  std::string upload_path = {};
  std::function<void(WebRequest request, WebReply reply)> upload = {};
  /// Names of sub-protocols, the preferred one first.
  std::vector<std::string> protocols;
  /// A WebSocket of one of these.
  std::function<std::unique_ptr<WebViewer>(const std::string& protocol)> connect;
};

}  // namespace collision::gateway
