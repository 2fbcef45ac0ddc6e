// Where the flight recorder and the journal of contacts keep their files, and how these are called.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace collision::wire {

/// Below the folder of the service (state_dir).
inline constexpr char kRecordingsFolder[] = "recordings";
inline constexpr char kContactsFolder[] = "contacts";
inline constexpr char kRecordingSuffix[] = ".rec";
inline constexpr char kContactsSuffix[] = ".contacts";

/// A file WORLD.DOMAIN.BEGIN.SUFFIX: "lab.0.20261129T030000.123Z.rec". Sorted by name, the files of
/// one world are in their order of time.
struct KeptFile {
  std::string path;
  std::string world;
  std::uint32_t domain = 0;
  std::int64_t begin_ns = 0;  ///< Wall time.
  std::uint64_t bytes = 0;

  std::string place() const { return world + "." + std::to_string(domain); }
};

/// The name of a file of "WORLD.DOMAIN".
std::string KeptFileName(const std::string& place, std::int64_t begin_ns, const char* suffix);

/// What is kept in a folder, by world and time; others are left out. Nothing where there is no such
/// folder.
std::vector<KeptFile> KeptFilesIn(const std::string& folder, const char* suffix);

/// Why a folder that is there cannot be listed: "Permission denied". Empty: it can be, or there is
/// none.
std::string ListingFailure(const std::string& folder);

/// Whether a service is writing to it now.
bool IsInUse(const std::string& path);

}  // namespace collision::wire
