// What a replay takes in and tells, for programs.
#pragma once

#include <ostream>

#include "idl/recording.pb.h"
#include "server/claim/service_claim.h"

namespace collision::server {

/// Writes entries as a recording has them (idl/recording.proto), and behind each batch what the
/// service told in its step. One header for each start of the service. One thread.
class Transcript {
 public:
  /// `stream` outlives it, and says whether it could be written.
  explicit Transcript(std::ostream* stream) : stream_(*stream) {}

  void Begin(const v1::Config& config, const ClaimOptions& claim);
  void Add(const v1::RecordedBatch& batch);
  void Add(std::int64_t wall_ns, const v1::Output& output);

 private:
  void Write(const v1::RecordingEntry& entry);

  std::ostream& stream_;
};

}  // namespace collision::server
