// Where credentials enter: the one place that turns a folder of them into DDS Security.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "dds/dds.h"

namespace collision::dds {

/// Who a program is on a secured network. All that DDS Security needs stands in one folder
/// (idl/credentials/files.h); the plugins are those of Cyclone DDS. It outlives the participant.
class Credentials {
 public:
  /// Throws std::runtime_error, naming the file, if one of them is missing, cannot be read or has
  /// ended, or if this process takes part in the domain with others already: Cyclone DDS 0.10 would
  /// judge both by the permissions of the first. What else is wrong with them it says when the
  /// participant is made. Any thread.
  Credentials(const std::string& folder, std::uint32_t domain);

  /// Makes a participant with this QoS a secured one. It goes before what a network profile says.
  void Apply(dds_qos_t* participant) const;

  const std::string& folder() const { return folder_; }

  /// The file that ends first, and its last second [s since 1970].
  const std::string& first_to_end() const { return first_to_end_; }
  std::int64_t end() const { return end_; }

 private:
  std::string folder_;
  std::shared_ptr<const std::string> held_;  ///< The one folder of this process, for the domain.
  std::string first_to_end_;
  std::int64_t end_ = 0;
};

}  // namespace collision::dds
