// Which recordings this program reads.
#pragma once

#include <string>

#include "idl/recording.pb.h"

namespace collision::wire {

/// The format of recordings: messages of wire revision 2 or 3, which are alike in all that
/// is recorded (recording.proto). Formats 1 and 2 hold
/// older ones, which only programs of their time read.
inline constexpr unsigned kRecordingFormat = 3;

/// Why a recording with this header cannot be read, as a sentence; empty: its format is the one.
inline std::string RefusalOfFormat(const v1::RecordingHeader& header) {
  if (header.format() == kRecordingFormat) return "";
  return "format " + std::to_string(header.format()) + ", written by version \"" +
         header.version() + "\"; this program reads format " + std::to_string(kRecordingFormat) +
         " only: use the version that wrote it";
}

}  // namespace collision::wire
