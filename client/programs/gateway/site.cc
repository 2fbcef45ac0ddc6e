#include "client/programs/gateway/site.h"

#include <charconv>
#include <string_view>

#include "client/library/identity/library_version.h"
#include "client/programs/tools/collisionctl/json/json_writer.h"

namespace collision::gateway {
namespace {

constexpr std::string_view kShapes = "/shapes/";

/// The bytes of "0f3a..."; empty if it is none.
std::string BytesOf(std::string_view hexadecimal) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hexadecimal.size(); i += 2) {
    unsigned value = 0;
    const char* const end = hexadecimal.data() + i + 2;
    if (std::from_chars(hexadecimal.data() + i, end, value, 16).ptr != end) return "";
    bytes += static_cast<char>(value);
  }
  return bytes;
}

WebResponse Text(int status, const std::string& text) {
  return {.status = status,
          .body = MakePayload(text + "\n"),
          .headers = {{"Cache-Control", "no-store"}}};
}

}  // namespace

WebResponse Site::Answer(const WebRequest& request) const {
  const std::string& path = request.path;
  if (request.method == "POST") return Text(405, "nothing here takes POST");
  if (path == "/healthz") return Text(200, "the gateway runs");
  if (path == "/readyz") {
    const std::lock_guard lock(mutex_);
    return Text(readiness_.is_ready ? 200 : 503, readiness_.text);
  }
  if (path == "/version") {
    return {.type = "application/json",
            .body = MakePayload(client::JsonObject()
                                    .Text("program", "collision-gateway")
                                    .Text("version", client::LibraryVersion())
                                    .Json() +
                                "\n")};
  }
  if (path == "/metrics") {
    const std::lock_guard lock(mutex_);
    if (!metrics_) return Text(503, "nothing has been heard yet");
    return {.type = "text/plain; version=0.0.4; charset=utf-8", .body = metrics_};
  }
  if (path == "/past") {
    return {.type = "application/octet-stream",
            .body = MakePayload(past_.Items()),
            .headers = {{"Cache-Control", "no-store"}}};
  }
  if (path.starts_with(kShapes)) return Shape(path.substr(kShapes.size()));
  if (files_ == nullptr) return Text(404, "this gateway has no page: see --page");
  return files_->Answer(path, request.takes_gzip);
}

WebResponse Site::Shape(const std::string& name) const {
  const Payload bytes = shapes_.Find(BytesOf(name));
  if (!bytes) return Text(404, "no shape of that hash is here");
  return {.type = "application/octet-stream",
          .body = bytes,
          .headers = {{"Cache-Control", "max-age=31536000, immutable"}}};
}

void Site::SetReadiness(Readiness readiness) {
  const std::lock_guard lock(mutex_);
  readiness_ = std::move(readiness);
}

void Site::SetMetrics(Payload metrics) {
  const std::lock_guard lock(mutex_);
  metrics_ = std::move(metrics);
}

}  // namespace collision::gateway
