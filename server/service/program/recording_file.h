// The file of --record: when it gets its name.
#pragma once

#include <memory>
#include <string>

#include "idl/config.pb.h"
#include "server/claim/service_claim.h"
#include "server/recording/recording.h"

namespace collision::server {

/// Under another name, FILE.new, until the service works: one that does not come up, or is refused
/// the world, and is started again and again, is not to replace what earlier ones have recorded. A
/// FILE that is no regular one (a pipe) is written to at once.
class RecordingFile {
 public:
  /// Empty: nothing is recorded.
  explicit RecordingFile(const std::string& file);
  /// Removes what has not got its name.
  ~RecordingFile();
  RecordingFile(const RecordingFile&) = delete;
  RecordingFile& operator=(const RecordingFile&) = delete;

  /// Null where nothing is to be recorded. Throws std::runtime_error.
  std::unique_ptr<RecordingWriter> Open(const v1::Config& config, const ClaimOptions& claim) const;

  /// Gives it its name, and former ones theirs (KeepFormerRecordings()). If that fails it says so
  /// in the log, and the recording keeps its other name.
  void Keep();

 private:
  const std::string file_;
  std::string first_;  ///< Its name before; `file_` once it has that one.
};

}  // namespace collision::server
