// The two documents of DDS Security that say what a world protects and what each program may do.
#pragma once

#include <cstdint>
#include <string>

#include "idl/dds/session.h"

namespace collision::dds {

/// Made from the same table of topics as the readers and writers (../topics.h): what a program may
/// do is what its role does (DdsRole), in the same partitions, and nothing else.
struct Grantee {
  std::string world;
  std::uint32_t domain = 0;
  DdsRole role = DdsRole::kMonitor;  ///< Not kWatcher: monitors and operators may watch.
  std::string name;                  ///< kSimulator: that of its partition.
  bool monitors = false;             ///< kSimulator: it does what a monitor does as well.
  std::string subject;               ///< Of its certificate, as RFC 2253 writes it.
  std::int64_t not_before = 0;       ///< [s since 1970]
  std::int64_t not_after = 0;        ///< Likewise.
};

/// What each packet of a secured world carries. Access control alone would keep nobody out: a
/// stranger who knows the GUID of a writer, which is no secret, forges its samples with one packet.
enum class Protection {
  /// A code that only the programs of the world can make. Readers share the key of a writer: one
  /// that is let in could forge what the writer says to others.
  kSign,
  /// A code for each reader as well: a reader cannot forge, and a packet grows with each.
  kSignForEachReader,
  kEncrypt,  ///< As kSign, and not readable by strangers.
};

/// The same for all programs of a world, or they do not match.
std::string GovernanceXml(std::uint32_t domain, Protection protection);

/// Throws std::invalid_argument for a role without permissions.
std::string PermissionsXml(const Grantee& grantee);

}  // namespace collision::dds
