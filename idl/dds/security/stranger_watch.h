// Programs that a secured network keeps out.
#pragma once

#include <array>
#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "dds/dds.h"

namespace collision::dds {

/// Notices programs that are in the DDS domain and have not shown valid credentials. DDS Security
/// itself says nothing about one that has none; about one of another authority the two may say
/// something, or only the stranger. But discovery lists both, and of those that are kept out no
/// reader or writer. One thread.
class StrangerWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// `participant`: the one that they are kept out of.
  explicit StrangerWatch(dds_entity_t participant);

  /// Those that were first seen kPatience ago and are kept out, each once: process, number and
  /// host, as they say themselves, in any bytes. Looks once a second, however often it is called.
  std::vector<std::string> Look(Time now);

 private:
  using Id = std::array<unsigned char, 16>;

  /// Authentication takes less, also where many programs start at once.
  static constexpr std::chrono::seconds kPatience{5};
  static constexpr std::chrono::seconds kPeriod{1};

  /// Programs that are remembered; of further ones nothing is told.
  static constexpr std::size_t kProgramsMax = 1024;

  /// One whose certificate is refused comes and goes: DDS tries again each second.
  struct Program {
    Time first_seen = {};
    Time last_seen = {};
    bool is_settled = false;  ///< Admitted or told.
  };

  std::map<Id, std::string> Present() const;
  void SettleAdmitted(dds_entity_t endpoints);

  dds_entity_t participants_, publications_, subscriptions_;
  Id own_;
  std::map<Id, Program> programs_;
  Time due_{};
};

}  // namespace collision::dds
