#include "client/programs/tools/certificates/authority.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>

#include "client/programs/tools/certificates/profile.h"
#include "idl/credentials/files.h"
#include "idl/credentials/validity.h"
#include "idl/limits.h"

namespace collision::client {
namespace {

namespace fs = std::filesystem;

constexpr char kFolder[] = "authority", kIdentityKey[] = "identity_ca.key",
               kPermissionsKey[] = "permissions_ca.key", kWorld[] = "world";

constexpr std::int64_t kAuthoritySeconds = std::int64_t{10} * 366 * 86400;

constexpr mode_t kForOwner = 0600, kForAll = 0644;

SigningError FileError(const std::string& path, int error) {
  return SigningError(path + ": " + std::generic_category().message(error));
}

/// Never over a file that is there.
void Write(const std::string& path, const std::string& text, mode_t mode) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  if (file < 0) throw FileError(path, errno);
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t more = write(file, text.data() + written, text.size() - written);
    if (more < 0 && errno == EINTR) continue;
    if (more <= 0) break;
    written += static_cast<std::size_t>(more);
  }
  const int error = errno;
  const bool closed = close(file) == 0;
  if (written < text.size()) throw FileError(path, error);
  if (!closed) throw FileError(path, errno);
}

std::string Read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(path, errno);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Files that are all there or not at all: they are written beside their folder, which then gets
/// its name.
class NewFolder {
 public:
  explicit NewFolder(const std::string& path) : path_(path), beside_(path + ".XXXXXX") {
    if (fs::exists(path)) {
      throw SigningError(path +
                         ": is there already, and is not written over: move it away to make new "
                         "ones");
    }
    if (mkdtemp(beside_.data()) == nullptr) throw FileError(path, errno);
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;
  ~NewFolder() {
    std::error_code ignored;
    if (!beside_.empty()) fs::remove_all(beside_, ignored);
  }

  void Add(const std::string& name, const std::string& text, mode_t mode = kForAll) const {
    Write(beside_ + "/" + name, text, mode);
  }

  void Keep() {
    std::error_code error;
    fs::rename(beside_, path_, error);
    if (error) throw SigningError(path_ + ": " + error.message());
    beside_.clear();
  }

 private:
  std::string path_, beside_;
};

struct NamedProtection {
  const char* name;
  dds::Protection protection;
};
constexpr NamedProtection kProtections[] = {
    {"sign", dds::Protection::kSign},
    {"sign-for-each-reader", dds::Protection::kSignForEachReader},
    {"encrypt", dds::Protection::kEncrypt}};

std::string TextOf(const SecuredWorld& world) {
  return "world " + world.world + "\ndomain " + std::to_string(world.domain) + "\nprotection " +
         NameOf(world.protection) + "\n";
}

/// As TextOf() wrote it.
SecuredWorld WorldIn(const std::string& path) {
  std::istringstream text(Read(path));
  SecuredWorld world;
  std::string words[3], protection;
  text >> words[0] >> world.world >> words[1] >> world.domain >> words[2] >> protection;
  const auto known = ProtectionOf(protection);
  if (!text || !wire::IsName(world.world) || world.domain > wire::kDomainMax || !known) {
    throw SigningError(path +
                       ": is damaged; it says \"world NAME\", \"domain NUMBER\", "
                       "\"protection NAME\", each on a line");
  }
  world.protection = *known;
  return world;
}

/// Throws SigningError, naming both files, if they do not belong together.
KeyAndCertificate PairIn(const std::string& key, const std::string& certificate) {
  KeyAndCertificate pair{Read(key), Read(certificate)};
  try {
    Sign(pair, "");
  } catch (const SigningError& error) {
    throw SigningError(key + ", " + certificate +
                       ": one is damaged, or they do not belong together: " + error.what());
  }
  return pair;
}

/// What the world protects: of the same content whenever it is signed.
std::string GovernanceOf(const KeyAndCertificate& permissions, const SecuredWorld& world) {
  return Sign(permissions, dds::GovernanceXml(world.domain, world.protection));
}

const char* RoleText(DdsRole role) {
  switch (role) {
    case DdsRole::kService:
      return "service";
    case DdsRole::kSimulator:
      return "simulator";
    case DdsRole::kMonitor:
      return "monitor";
    case DdsRole::kOperator:
      return "operator";
    case DdsRole::kWatcher:
      break;
  }
  throw std::logic_error("no bearer of credentials has this role");
}

}  // namespace

std::string NameOf(dds::Protection protection) {
  for (const auto& [name, value] : kProtections) {
    if (value == protection) return name;
  }
  throw std::logic_error("a protection without a name");
}

std::optional<dds::Protection> ProtectionOf(const std::string& name) {
  for (const auto& [known, value] : kProtections) {
    if (name == known) return value;
  }
  return std::nullopt;
}

std::optional<Authority> Authority::Open(const std::string& folder) {
  const std::string own = folder + "/" + kFolder + "/";
  if (!fs::exists(own)) return std::nullopt;
  Authority authority(folder);
  authority.world_ = WorldIn(own + kWorld);
  authority.identity_ = PairIn(own + kIdentityKey, own + credentials::kIdentityCa);
  authority.permissions_ = PairIn(own + kPermissionsKey, own + credentials::kPermissionsCa);
  authority.governance_ = GovernanceOf(authority.permissions_, authority.world_);
  return authority;
}

Authority Authority::Make(const std::string& folder, const SecuredWorld& world, std::int64_t now) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw SigningError(folder + ": " + error.message());
  const Period period{now - kBeforehand, now + kAuthoritySeconds};
  Authority authority(folder);
  authority.world_ = world;
  authority.identity_ = MakeAuthority({world.world, "authority", "identity"}, period);
  authority.permissions_ = MakeAuthority({world.world, "authority", "permissions"}, period);
  authority.governance_ = GovernanceOf(authority.permissions_, world);
  NewFolder own(folder + "/" + kFolder);
  own.Add(kIdentityKey, authority.identity_.key, kForOwner);
  own.Add(credentials::kIdentityCa, authority.identity_.certificate);
  own.Add(kPermissionsKey, authority.permissions_.key, kForOwner);
  own.Add(credentials::kPermissionsCa, authority.permissions_.certificate);
  own.Add(credentials::kGovernance, authority.governance_);
  own.Add(kWorld, TextOf(world));
  own.Keep();
  return authority;
}

std::string Authority::FolderOf(const std::string& folder, const Bearer& bearer) {
  const std::string role = RoleText(bearer.role);
  return folder + "/" + (bearer.role == DdsRole::kService ? role : role + "-" + bearer.name);
}

std::string Authority::Issue(const Bearer& bearer, const Period& period) const {
  if (!wire::IsName(bearer.name)) {
    throw SigningError("\"" + bearer.name + "\", allowed: " + wire::kNameText);
  }
  Period shorter = period;
  for (const std::string& certificate : {identity_.certificate, permissions_.certificate}) {
    shorter.end = std::min(shorter.end, credentials::EndOfCertificate(certificate).value_or(0));
  }
  const Subject subject{world_.world, RoleText(bearer.role), bearer.name};
  const KeyAndCertificate own = client::Issue(identity_, subject, shorter);
  const dds::Grantee grantee{.world = world_.world,
                             .domain = world_.domain,
                             .role = bearer.role,
                             .name = bearer.name,
                             .monitors = bearer.monitors,
                             .subject = client::TextOf(subject),
                             .not_before = shorter.begin,
                             .not_after = shorter.end};
  const std::string path = FolderOf(bearer);
  NewFolder folder(path);
  folder.Add(credentials::kIdentityCa, identity_.certificate);
  folder.Add(credentials::kCertificate, own.certificate);
  folder.Add(credentials::kKey, own.key, kForOwner);
  folder.Add(credentials::kPermissionsCa, permissions_.certificate);
  folder.Add(credentials::kGovernance, governance_);
  folder.Add(credentials::kPermissions, Sign(permissions_, dds::PermissionsXml(grantee)));
  folder.Add(kProfile, SecurityProfile());
  folder.Keep();
  return path;
}

}  // namespace collision::client
