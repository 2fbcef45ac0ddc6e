// Which services this simulator can work with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "collision/types.h"
#include "idl/messages.pb.h"

namespace collision::client {

/// What a simulator states of itself in its hello, and compares with that of a service.
struct OwnFacts {
  std::string simulator;
  bool lock_step = true;
  std::string frame;
};

v1::SimulatorHello HelloOf(const OwnFacts& own, std::uint64_t simulator_id,
                           std::uint32_t incarnation);

/// Compares hellos. What a service that does not fit says means nothing here. One thread.
class ServiceFit {
 public:
  /// Services that are remembered; of more, any is forgotten until its next hello.
  static constexpr std::size_t kServicesMax = 16;

  explicit ServiceFit(OwnFacts own) : own_(std::move(own)) {}

  /// Why this service does not fit, in the form of a refusal by it: once for each service. nullopt:
  /// it fits, or that was told.
  std::optional<Rejection> Hear(const v1::ServiceHello& hello);

  bool IsUnfit(std::uint64_t service_id) const { return unfit_.contains(service_id); }

  /// Those that do not fit.
  std::vector<Rejection> Unfit() const;

  /// A sentence for people about one of them; empty: all fit.
  std::string Text() const;

  /// The regions of the world, as this service has named them; empty: it has not.
  const std::vector<std::uint32_t>& RegionsOf(std::uint64_t service_id) const;

 private:
  std::optional<Rejection> Compare(const v1::ServiceHello& hello) const;

  const OwnFacts own_;
  std::map<std::uint64_t, Rejection> unfit_;
  std::map<std::uint64_t, std::vector<std::uint32_t>> regions_;
};

}  // namespace collision::client
