// HTTP and WebSockets on one port.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "client/programs/gateway/web/web_types.h"

namespace collision::gateway {

struct WebOptions {
  std::string address = "127.0.0.1";  ///< IPv4 or IPv6 address to listen on.
  std::uint16_t port = 8787;          ///< 0: any that is free.
  /// What a request must bring: "Authorization: Bearer TOKEN", the cookie that the server then
  /// sets, or "?token=TOKEN". Empty: nothing.
  std::string token = {};
  /// Names by which browsers may call the server, beside those of this machine's loopback: any
  /// other Host is refused, so that no page from elsewhere can read it by a name of its own.
  std::vector<std::string> hosts = {};
  /// Pages from elsewhere that may open WebSockets: "https://app.foxglove.dev".
  std::vector<std::string> origins = {};
  std::size_t connections_max = 1024;        ///< Further ones are closed at once.
  std::size_t request_bytes_max = 1 << 16;   ///< Of a body; more is answered with 413.
  std::size_t upload_bytes_max = 256 << 20;  ///< Likewise, to WebHandlers::upload_path.
  int send_buffer_bytes = 128 << 10;         ///< Of a socket: what lies in it gets old.
};

/// Serves from its construction on, on a thread of its own; what it asks of the program is called
/// there. Any thread may call it.
class WebServer {
 public:
  /// Throws std::runtime_error, with address and cause, if it cannot listen.
  WebServer(const WebOptions& options, WebHandlers handlers);

  /// Closes all connections.
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  std::uint16_t port() const;

  /// There is something new: each viewer that can take a message is asked for it.
  void Wake();

 private:
  class Implementation;
  const std::unique_ptr<Implementation> implementation_;
};

}  // namespace collision::gateway
