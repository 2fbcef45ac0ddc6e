#include "client/programs/gateway/web/web_server.h"

#include <atomic>
#include <boost/asio/dispatch.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <iostream>
#include <set>
#include <stdexcept>
#include <thread>

#include "client/programs/gateway/web/access.h"

namespace collision::gateway {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using boost::system::error_code;

constexpr std::chrono::seconds kPatience{30};        ///< With a connection that says nothing.
constexpr std::chrono::minutes kUploadPatience{10};  ///< With one that sends or gets a file.
constexpr std::size_t kUploadsMax = 1;
constexpr std::size_t kLargeAnswer = 1 << 20;
constexpr std::chrono::milliseconds kAcceptAgain{100};  ///< After too many open files.
constexpr std::size_t kPathMax = 2048;
constexpr std::size_t kViewerMessageMax = 1 << 16;

class ViewerSession;

/// What all connections share; on the server's thread alone.
struct Common {
  WebOptions options;
  AccessRules access;
  WebHandlers handlers;
  std::set<ViewerSession*> viewers = {};
  std::size_t connections = 0;
  std::size_t uploads = 0;
};

/// One of so many that there may be at a time.
class Place {
 public:
  explicit Place(std::size_t* taken) : taken_(*taken) { ++taken_; }
  ~Place() { --taken_; }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;

 private:
  std::size_t& taken_;
};

/// A page from elsewhere asks, one of those that may look.
bool IsFromElsewhere(const RequestHead& head) {
  return !head.origin.empty() && head.origin != "http://" + head.host &&
         head.origin != "https://" + head.host;
}

std::string TextOf(beast::string_view view) { return {view.data(), view.size()}; }

/// A WebSocket. It holds itself while an operation of it is under way.
class ViewerSession : public std::enable_shared_from_this<ViewerSession> {
 public:
  ViewerSession(beast::tcp_stream&& stream, Common* common, std::unique_ptr<WebViewer> viewer)
      : stream_(std::move(stream)),
        common_(common),
        place_(&common->connections),
        viewer_(std::move(viewer)) {
    common_->viewers.insert(this);
  }
  ~ViewerSession() { common_->viewers.erase(this); }
  ViewerSession(const ViewerSession&) = delete;
  ViewerSession& operator=(const ViewerSession&) = delete;

  void Start(const http::request<http::string_body>& request, const std::string& protocol) {
    websocket::stream_base::timeout limits =
        websocket::stream_base::timeout::suggested(beast::role_type::server);
    limits.idle_timeout = kPatience;
    limits.keep_alive_pings = true;
    stream_.set_option(limits);
    stream_.read_message_max(kViewerMessageMax);
    stream_.auto_fragment(false);
    if (!protocol.empty()) {
      stream_.set_option(
          websocket::stream_base::decorator([protocol](websocket::response_type& response) {
            response.set(http::field::sec_websocket_protocol, protocol);
          }));
    }
    beast::get_lowest_layer(stream_).expires_never();
    stream_.async_accept(request, [self = shared_from_this()](error_code failed) {
      if (failed) return;
      self->is_open_ = true;
      self->Read();
      self->Write();
    });
  }

  /// Sends the next message, if there is one and none is under way.
  void Write() {
    if (!is_open_ || is_writing_) return;
    message_ = viewer_->Next();
    if (!message_) return;
    stream_.text(message_->is_text);
    std::vector<asio::const_buffer> buffers;
    for (const Payload& piece : message_->pieces) buffers.emplace_back(asio::buffer(*piece));
    is_writing_ = true;
    stream_.async_write(buffers, [self = shared_from_this()](error_code failed, std::size_t) {
      self->is_writing_ = false;
      if (failed) return self->End();
      self->Write();
    });
  }

  void Close(websocket::close_code code, const std::string& why) {
    if (!is_open_) return;
    is_open_ = false;
    stream_.async_close({code, why.substr(0, 120)}, [self = shared_from_this()](error_code) {});
  }

 private:
  void Read() {
    stream_.async_read(buffer_, [self = shared_from_this()](error_code failed, std::size_t) {
      if (failed) return self->End();
      const std::string message = beast::buffers_to_string(self->buffer_.data());
      self->buffer_.clear();
      const std::string wrong = self->viewer_->Hear(message, self->stream_.got_text());
      if (!wrong.empty()) return self->Close(websocket::close_code::policy_error, wrong);
      self->Write();
      self->Read();
    });
  }

  void End() {
    is_open_ = false;
    beast::get_lowest_layer(stream_).close();
  }

  websocket::stream<beast::tcp_stream, false> stream_;
  Common* const common_;
  const Place place_;
  const std::unique_ptr<WebViewer> viewer_;
  beast::flat_buffer buffer_;
  std::optional<WebMessage> message_;  ///< That is under way.
  bool is_open_ = false;
  bool is_writing_ = false;
};

/// Requests of one connection, until it becomes a WebSocket.
class HttpSession : public std::enable_shared_from_this<HttpSession> {
 public:
  HttpSession(tcp::socket&& socket, Common* common)
      : stream_(std::move(socket)),
        common_(common),
        place_(std::make_unique<Place>(&common->connections)) {}

  /// The head first: who may not ask need not send the rest.
  void Read() {
    parser_.emplace();
    query_.clear();
    parser_->body_limit(common_->options.upload_bytes_max);
    stream_.expires_after(kPatience);
    http::async_read_header(stream_, buffer_, *parser_,
                            [self = shared_from_this()](error_code failed, std::size_t) {
                              if (failed == http::error::body_limit)
                                return self->Refuse(413, "too large");
                              if (!failed) return self->TakeHead();
                              self->stream_.close();
                            });
  }

 private:
  using Request = http::request<http::string_body>;

  void TakeHead() {
    const Request& request = parser_->get();
    const std::string target = TextOf(request.target());
    const std::size_t mark = std::min(target.find('?'), target.size());
    const auto path = DecodePercent(target.substr(0, mark));
    query_ = mark < target.size() ? target.substr(mark + 1) : "";
    if (!path || path->size() > kPathMax) return Refuse(400, "that path cannot be");
    path_ = *path;
    const RequestHead head{.host = TextOf(request[http::field::host]),
                           .origin = TextOf(request[http::field::origin]),
                           .authorization = TextOf(request[http::field::authorization]),
                           .cookie = TextOf(request[http::field::cookie]),
                           .query = query_};
    if (const auto refusal = JudgeAccess(common_->access, head)) {
      return Refuse(refusal->status, refusal->why);
    }
    if (websocket::is_upgrade(request)) return BecomeViewer();
    const bool is_upload = request.method() == http::verb::post && !path_.empty() &&
                           path_ == common_->handlers.upload_path;
    if (is_upload && IsFromElsewhere(head)) {
      return Refuse(403, "only pages of this server may upload");
    }
    if (is_upload && common_->uploads >= kUploadsMax) {
      return Refuse(503, "another file is being uploaded");
    }
    if (is_upload) upload_ = std::make_unique<Place>(&common_->uploads);
    const std::size_t most =
        is_upload ? common_->options.upload_bytes_max : common_->options.request_bytes_max;
    if (parser_->content_length().value_or(0) > most) return Refuse(413, "too large");
    parser_->body_limit(most);
    stream_.expires_after(is_upload ? kUploadPatience : kPatience);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this(), is_upload](error_code failed, std::size_t) {
                       if (failed == http::error::body_limit) return self->Refuse(413, "too large");
                       if (failed) return self->stream_.close();
                       is_upload ? self->HandleUpload() : self->Handle();
                     });
  }

  void HandleUpload() {
    // Whoever answers holds the session no longer than until then: it ends on the server's thread.
    const auto held = std::make_shared<std::shared_ptr<HttpSession>>(shared_from_this());
    common_->handlers.upload({.method = "POST",
                              .path = path_,
                              .query = query_,
                              .body = std::move(parser_->get().body())},
                             [held](WebResponse answer) {
                               std::shared_ptr<HttpSession> self = std::move(*held);
                               const auto executor = self->stream_.get_executor();
                               asio::post(executor,
                                          [self = std::move(self), answer = std::move(answer)] {
                                            self->upload_.reset();
                                            self->Send(answer);
                                          });
                             });
  }

  void Handle() {
    const Request& request = parser_->get();
    const http::verb verb = request.method();
    if (verb != http::verb::get && verb != http::verb::head && verb != http::verb::post) {
      return Refuse(405, "GET, HEAD and POST are what there is");
    }
    const bool takes_gzip =
        request[http::field::accept_encoding].find("gzip") != beast::string_view::npos;
    Send(common_->handlers.answer({.method = TextOf(request.method_string()),
                                   .path = path_,
                                   .query = query_,
                                   .takes_gzip = takes_gzip,
                                   .body = request.body()}));
  }

  void BecomeViewer() {
    const Request& request = parser_->get();
    std::set<std::string> offered;
    for (const auto& name : http::token_list(request[http::field::sec_websocket_protocol])) {
      offered.insert(TextOf(name));
    }
    for (const std::string& protocol : common_->handlers.protocols) {
      if (offered.count(protocol) == 0) continue;
      place_.reset();  // it is the viewer's now
      std::make_shared<ViewerSession>(std::move(stream_), common_,
                                      common_->handlers.connect(protocol))
          ->Start(request, protocol);
      return;
    }
    std::string names;
    for (const std::string& one : common_->handlers.protocols) names += " " + one;
    Refuse(400, "a WebSocket here speaks one of:" + names);
  }

  void Refuse(int status, const std::string& why) {
    Send({.status = status, .body = MakePayload(why + "\n")});
  }

  /// The body is not copied: viewers share it.
  void Send(WebResponse answer) {
    const Request& request = parser_->get();
    answer_ = std::move(answer);
    if (!answer_.body) answer_.body = MakePayload("");
    response_ = {};
    response_.result(static_cast<unsigned>(answer_.status));
    response_.version(request.version() == 0 ? 11 : request.version());
    response_.set(http::field::content_type, answer_.type);
    response_.set("X-Content-Type-Options", "nosniff");
    for (const auto& [name, value] : answer_.headers) response_.set(name, value);
    if (QueryHasToken(common_->access, query_)) {
      response_.set(http::field::set_cookie, std::string(kTokenCookie) + "=" +
                                                 common_->access.token +
                                                 "; HttpOnly; SameSite=Strict; Path=/");
    }
    const bool is_head = request.method() == http::verb::head;
    response_.body().data = is_head ? nullptr : const_cast<char*>(answer_.body->data());
    response_.body().size = is_head ? 0 : answer_.body->size();
    response_.body().more = false;
    response_.content_length(answer_.body->size());
    response_.keep_alive(answer_.status < 400 && request.keep_alive());
    serializer_.emplace(response_);
    stream_.expires_after(answer_.body->size() > kLargeAnswer ? kUploadPatience : kPatience);
    http::async_write(stream_, *serializer_,
                      [self = shared_from_this()](error_code failed, std::size_t) {
                        if (!failed && self->response_.keep_alive()) return self->Read();
                        error_code ignored;
                        self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
                      });
  }

  beast::tcp_stream stream_;
  Common* const common_;
  std::unique_ptr<Place> place_, upload_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  std::string path_, query_;  ///< Of the request.
  WebResponse answer_;
  http::response<http::buffer_body> response_;
  std::optional<http::response_serializer<http::buffer_body>> serializer_;
};

}  // namespace

class WebServer::Implementation {
 public:
  Implementation(const WebOptions& options, WebHandlers handlers)
      : common_{.options = options,
                .access = {.token = options.token,
                           .hosts = options.hosts,
                           .origins = options.origins},
                .handlers = std::move(handlers)},
        acceptor_(context_),
        again_(context_) {
    Listen();
    Accept();
    thread_ = std::thread([this] { Serve(); });
  }

  ~Implementation() {
    asio::post(context_, [this] { context_.stop(); });
    thread_.join();
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  std::uint16_t port() const { return acceptor_.local_endpoint().port(); }

  void Wake() {
    if (is_awake_.exchange(true)) return;
    asio::post(context_, [this] {
      is_awake_ = false;
      const std::set<ViewerSession*> viewers = common_.viewers;
      for (ViewerSession* viewer : viewers) viewer->Write();
    });
  }

 private:
  /// What one connection takes too much of ends that one.
  void Serve() {
    for (;;) {
      try {
        context_.run();
        return;
      } catch (const std::exception& failure) {
        std::cerr << "collision-gateway: a connection has failed: " << failure.what() << '\n';
      }
    }
  }

  void Listen() {
    const WebOptions& options = common_.options;
    error_code failed;
    const auto address = asio::ip::make_address(options.address, failed);
    const std::string place = options.address + " port " + std::to_string(options.port);
    if (failed) throw std::runtime_error(options.address + ": not an IPv4 or IPv6 address");
    const tcp::endpoint endpoint(address, options.port);
    acceptor_.open(endpoint.protocol(), failed);
    if (!failed) acceptor_.set_option(asio::socket_base::reuse_address(true), failed);
    if (!failed) acceptor_.bind(endpoint, failed);
    if (!failed) acceptor_.listen(asio::socket_base::max_listen_connections, failed);
    if (failed) throw std::runtime_error("cannot listen on " + place + ": " + failed.message());
  }

  void Accept() {
    acceptor_.async_accept([this](error_code failed, tcp::socket socket) {
      if (failed) {
        // Of too many open files no one goes away by being asked at once.
        again_.expires_after(kAcceptAgain);
        return again_.async_wait([this](error_code) { Accept(); });
      }
      if (common_.connections < common_.options.connections_max) {
        Accept();
        error_code ignored;
        socket.set_option(tcp::no_delay(true), ignored);
        socket.set_option(asio::socket_base::send_buffer_size(common_.options.send_buffer_bytes),
                          ignored);
        return std::make_shared<HttpSession>(std::move(socket), &common_)->Read();
      }
      Accept();
    });
  }

  Common common_;  // before the context, whose operations hold sessions
  asio::io_context context_{1};
  tcp::acceptor acceptor_;
  asio::steady_timer again_;
  std::atomic<bool> is_awake_ = false;
  std::thread thread_;
};

WebServer::WebServer(const WebOptions& options, WebHandlers handlers)
    : implementation_(std::make_unique<Implementation>(options, std::move(handlers))) {}

WebServer::~WebServer() = default;

std::uint16_t WebServer::port() const { return implementation_->port(); }

void WebServer::Wake() { implementation_->Wake(); }

}  // namespace collision::gateway
