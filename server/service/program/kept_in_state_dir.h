// What a service keeps for people, in the folder of its journal.
#pragma once

#include <memory>
#include <string>

#include "idl/config.pb.h"
#include "server/claim/service_claim.h"
#include "server/recording/contact_journal.h"
#include "server/recording/flight_recorder.h"

namespace collision::server {

/// Either is null where `state_dir` is empty, or its size 0.
struct KeptInStateDir {
  std::unique_ptr<FlightRecorder> flight;
  std::unique_ptr<ContactJournal> contacts;
  std::string about_flight = {};  ///< For the log: where, and how much.

  /// Once the service works: before that neither touches a file.
  void Start() const;

  /// How much is kept from now on; what is null stays so. `config` is complete.
  void SetLimits(const v1::Config& config) const;
};

/// A segment has at most so much of all that may be kept: the oldest to go is not the only one.
inline constexpr std::uint64_t kSegmentsLeast = 4;

/// `config` is complete. Throws nothing about files: what cannot be written is logged, and tried
/// again.
KeptInStateDir OpenKept(const v1::Config& config, const ClaimOptions& claim);

}  // namespace collision::server
