// Where credentials enter: the one place that turns a folder of them into DDS Security.
#pragma once

#include <cstdint>
#include <string>

#include "dds/dds.h"

namespace collision::dds {

/// Who a program is on a secured network. All that DDS Security needs stands in one folder
/// (idl/credentials/files.h); the plugins are those of Cyclone DDS.
class Credentials {
 public:
  /// Throws std::runtime_error, naming the file, if one of them is missing, cannot be read or has
  /// ended. What else is wrong with them Cyclone DDS says when the participant is made.
  explicit Credentials(const std::string& folder);

  /// Makes a participant with this QoS a secured one. It goes before what a network profile says.
  void Apply(dds_qos_t* participant) const;

  const std::string& folder() const { return folder_; }

  /// The file that ends first, and its last second [s since 1970].
  const std::string& first_to_end() const { return first_to_end_; }
  std::int64_t end() const { return end_; }

 private:
  std::string folder_;
  std::string first_to_end_;
  std::int64_t end_ = 0;
};

}  // namespace collision::dds
