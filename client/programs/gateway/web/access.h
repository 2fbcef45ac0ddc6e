// Who may ask what: requests that browsers make for pages from elsewhere are refused.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace collision::gateway {

/// As in WebOptions.
struct AccessRules {
  std::string token = {};
  std::vector<std::string> hosts = {};
  std::vector<std::string> origins = {};
};

/// What a request says of itself, as it was sent; empty: nothing.
struct RequestHead {
  std::string host = {};
  std::string origin = {};
  std::string authorization = {};
  std::string cookie = {};
  std::string query = {};
};

/// A status of HTTP, and why, in a sentence.
struct AccessRefusal {
  int status = 403;
  std::string why;
};

/// nullopt: it may. A browser sends Origin with each WebSocket and each POST, of whatever page
/// opens it, and any page can open one to this machine: so it must be a page of this server, or one
/// of `origins`. Programs send none. A Host that is no name of ours is of a page whose name
/// somebody else made point here.
std::optional<AccessRefusal> JudgeAccess(const AccessRules& rules, const RequestHead& head);

/// The name of the cookie that holds the token.
inline constexpr char kTokenCookie[] = "collision-token";

/// Whether the query brings the right token, so that a cookie is due.
bool QueryHasToken(const AccessRules& rules, const std::string& query);

/// The value of KEY in a query, KEY=VALUE&..., decoded; nullopt: it has none.
std::optional<std::string> QueryValue(const std::string& query, const std::string& key);

/// "%2F" and so on as what they stand for; nullopt: one of them is wrong.
std::optional<std::string> DecodePercent(const std::string& text);

}  // namespace collision::gateway
