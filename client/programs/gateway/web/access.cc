#include "client/programs/gateway/web/access.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <string_view>

namespace collision::gateway {
namespace {

/// A comparison whose time does not tell where the first difference is.
bool IsSame(std::string_view secret, std::string_view given) {
  if (secret.size() != given.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < secret.size(); ++i) {
    difference |= static_cast<unsigned char>(secret[i] ^ given[i]);
  }
  return difference == 0;
}

/// Without the port: "[::1]:8787" is "[::1]".
std::string NameOf(const std::string& host) {
  const std::size_t bracket = host.rfind(']');
  const std::size_t colon = host.rfind(':');
  const bool has_port =
      colon != std::string::npos && (bracket == std::string::npos || colon > bracket);
  std::string name = has_port ? host.substr(0, colon) : host;
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
  return name;
}

bool IsOurs(const AccessRules& rules, const std::string& host) {
  const std::string name = NameOf(host);
  if (name == "localhost" || name == "127.0.0.1" || name == "[::1]") return true;
  return std::ranges::count(rules.hosts, name) > 0;
}

bool HasToken(const AccessRules& rules, const RequestHead& head) {
  constexpr std::string_view kBearer = "Bearer ";
  if (head.authorization.starts_with(kBearer) &&
      IsSame(rules.token, std::string_view(head.authorization).substr(kBearer.size()))) {
    return true;
  }
  std::string_view rest = head.cookie;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(';'), rest.size());
    std::string_view one = rest.substr(0, end);
    while (one.starts_with(' ')) one.remove_prefix(1);
    const std::string key = std::string(kTokenCookie) + "=";
    if (one.starts_with(key) && IsSame(rules.token, one.substr(key.size()))) return true;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return QueryHasToken(rules, head.query);
}

}  // namespace

std::optional<AccessRefusal> JudgeAccess(const AccessRules& rules, const RequestHead& head) {
  if (!IsOurs(rules, head.host)) {
    return AccessRefusal{421, "this server has no name \"" + NameOf(head.host) +
                                  "\": allowed are localhost, its loopback addresses, and those of "
                                  "--host"};
  }
  const bool is_own_page =
      head.origin == "http://" + head.host || head.origin == "https://" + head.host;
  if (!head.origin.empty() && !is_own_page && std::ranges::count(rules.origins, head.origin) == 0) {
    return AccessRefusal{403, "pages of " + head.origin +
                                  " may not look: allowed are those of this " +
                                  "server and of --origin"};
  }
  if (!rules.token.empty() && !HasToken(rules, head)) {
    return AccessRefusal{401,
                         "a token is required: open /?token=TOKEN, or send \"Authorization: "
                         "Bearer TOKEN\""};
  }
  return std::nullopt;
}

bool QueryHasToken(const AccessRules& rules, const std::string& query) {
  const std::optional<std::string> given = QueryValue(query, "token");
  return !rules.token.empty() && given && IsSame(rules.token, *given);
}

std::optional<std::string> QueryValue(const std::string& query, const std::string& key) {
  std::string_view rest = query;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('&'), rest.size());
    const std::string_view one = rest.substr(0, end);
    if (one.starts_with(key) && one.substr(key.size()).starts_with('=')) {
      return DecodePercent(std::string(one.substr(key.size() + 1)));
    }
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return std::nullopt;
}

std::optional<std::string> DecodePercent(const std::string& text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    unsigned value = 0;
    if (i + 2 >= text.size()) return std::nullopt;
    const char* const end = text.data() + i + 3;
    if (std::from_chars(text.data() + i + 1, end, value, 16).ptr != end) return std::nullopt;
    decoded += static_cast<char>(value);
    i += 2;
  }
  return decoded;
}

}  // namespace collision::gateway
