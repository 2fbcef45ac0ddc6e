#include "server/recording/replay/transcript.h"

#include <string>

#include "idl/recording/entries.h"
#include "server/recording/recorded_claim.h"
#include "server/recording/recording.h"

namespace collision::server {

void Transcript::Begin(const v1::Config& config, const ClaimOptions& claim) {
  Write(HeaderOf(config, claim, 0));
}

void Transcript::Add(const v1::RecordedBatch& batch) {
  WriteInParts(batch, [this](const v1::RecordingEntry& entry) {
    Write(entry);
    return true;
  });
}

void Transcript::Add(std::int64_t wall_ns, const v1::Output& output) {
  v1::RecordingEntry entry;
  entry.mutable_told()->set_wall_ns(wall_ns);
  *entry.mutable_told()->mutable_output() = output;
  Write(entry);
}

void Transcript::Write(const v1::RecordingEntry& entry) {
  std::string bytes;
  wire::AppendEntry(entry, &bytes);
  stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace collision::server
