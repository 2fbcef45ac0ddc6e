// What all regions of a world allow together.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "idl/messages.pb.h"

namespace collision::client {

/// Keeps the newest clearance sample of each region and chunk, where a world has several regions,
/// and makes one of them: the least grant, and of each agent the least clearance. A region that has
/// not spoken grants nothing and promises nothing. All samples are of one service. One thread.
class RegionLeast {
 public:
  /// `regions`: those of the world, as the service names them; one or none: `told` itself is the
  /// answer, and nothing is kept. Valid until the next call.
  const v1::Clearance& Take(const v1::Clearance& told, const std::vector<std::uint32_t>& regions);

  /// Another service is in force.
  void Clear() { chunks_.clear(); }

 private:
  using ByRegion = std::map<std::uint32_t, v1::Clearance>;

  std::map<std::uint32_t, ByRegion> chunks_;
  v1::Clearance least_;
};

}  // namespace collision::client
