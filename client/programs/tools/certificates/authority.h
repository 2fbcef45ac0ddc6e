// The authority of one secured world, in a folder: it makes the credentials of programs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "client/programs/tools/certificates/signing.h"
#include "idl/dds/permissions/permissions.h"
#include "idl/dds/session.h"

namespace collision::client {

/// Certificates hold from so long before they are made, since clocks differ [s].
inline constexpr std::int64_t kBeforehand = 3600;

/// "sign", "sign-for-each-reader", "encrypt".
std::string NameOf(dds::Protection protection);
std::optional<dds::Protection> ProtectionOf(const std::string& name);

/// A world that an authority is for: its name and DDS domain stand in every permission.
struct SecuredWorld {
  std::string world;
  std::uint32_t domain = 0;
  dds::Protection protection = dds::Protection::kSign;
};

/// Who gets credentials. One service, operator or monitor may have several programs; a simulator
/// writes as `name` alone.
struct Bearer {
  DdsRole role = DdsRole::kMonitor;  ///< Not kWatcher.
  std::string name;
  bool monitors = false;  ///< kSimulator: its program is a monitor, too.
};

/// Keys and documents that all of a world trusts, in `folder`/authority:
///
///   identity_ca.key, identity_ca.pem        who signs certificates
///   permissions_ca.key, permissions_ca.pem  who signs the documents
///   governance.p7s                          what the world protects; signed anew for each bearer
///   world                                   its name, domain and protection
///
/// Whoever has the keys can let anybody in: they belong to no host on which programs run. Private
/// keys are readable by their owner alone, and no file that is there is ever written over.
class Authority {
 public:
  /// The one in this folder; nullopt: there is none. Throws SigningError, naming the file, if it is
  /// not whole.
  static std::optional<Authority> Open(const std::string& folder);

  /// Makes one that holds for ten years from `now` [s since 1970]. Throws SigningError.
  static Authority Make(const std::string& folder, const SecuredWorld& world, std::int64_t now);

  const SecuredWorld& world() const { return world_; }

  /// The folder of these credentials in that of an authority: "service", "simulator-alpha",
  /// "monitor-desk".
  static std::string FolderOf(const std::string& folder, const Bearer& bearer);
  std::string FolderOf(const Bearer& bearer) const { return FolderOf(folder_, bearer); }

  /// Makes credentials, in a folder of their own that must not be there. Returns that folder.
  /// Their period ends with the authority's at the latest. Throws SigningError.
  std::string Issue(const Bearer& bearer, const Period& period) const;

 private:
  explicit Authority(std::string folder) : folder_(std::move(folder)) {}

  std::string folder_;
  SecuredWorld world_;
  KeyAndCertificate identity_, permissions_;
  std::string governance_;
};

}  // namespace collision::client
