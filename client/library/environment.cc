#include "collision/environment.h"

#include <charconv>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "idl/credentials/files.h"
#include "idl/limits.h"

namespace collision::client {
namespace {

std::string Variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

}  // namespace

std::string DefaultWorld() {
  const std::string world = Variable("COLLISION_WORLD");
  return world.empty() ? "default" : world;
}

std::uint32_t DefaultDomain() {
  const std::string text = Variable("COLLISION_DOMAIN");
  if (text.empty()) return 0;
  std::uint32_t domain = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, domain);
  if (error != std::errc() || rest != end || domain > wire::kDomainMax) {
    throw std::invalid_argument("COLLISION_DOMAIN: " + text + ", allowed: 0 to " +
                                std::to_string(wire::kDomainMax));
  }
  return domain;
}

std::string DefaultCredentials() { return Variable(credentials::kVariable); }

}  // namespace collision::client
