#include "idl/recording/kept_files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <system_error>
#include <tuple>

#include "idl/recording/utc.h"

namespace collision::wire {
namespace {

std::optional<KeptFile> FileOf(const std::filesystem::path& path, const char* suffix) {
  static const std::regex form(R"(([A-Za-z0-9_-]{1,64})\.(\d{1,3})\.(\d{8}T\d{6}\.\d{3}Z))");
  const std::string name = path.filename().string(), end = suffix;
  if (!name.ends_with(end)) return std::nullopt;
  std::smatch match;
  const std::string stem = name.substr(0, name.size() - end.size());
  if (!std::regex_match(stem, match, form)) return std::nullopt;
  const std::optional<std::int64_t> begin = FromUtcOfFile(match[3]);
  if (!begin) return std::nullopt;
  std::error_code failed;
  KeptFile file{.path = path.string(),
                .world = match[1],
                .domain = static_cast<std::uint32_t>(std::stoul(match[2])),
                .begin_ns = *begin,
                .bytes = std::filesystem::file_size(path, failed)};
  if (failed) return std::nullopt;
  return file;
}

}  // namespace

std::string KeptFileName(const std::string& place, std::int64_t begin_ns, const char* suffix) {
  return place + "." + UtcOfFile(begin_ns) + suffix;
}

std::vector<KeptFile> KeptFilesIn(const std::string& folder, const char* suffix) {
  std::vector<KeptFile> files;
  std::error_code failed;
  for (auto entry = std::filesystem::directory_iterator(folder, failed);
       !failed && entry != std::filesystem::directory_iterator(); entry.increment(failed)) {
    if (auto file = FileOf(entry->path(), suffix)) files.push_back(std::move(*file));
  }
  const auto key = [](const KeptFile& file) {
    return std::tie(file.world, file.domain, file.begin_ns);
  };
  std::ranges::sort(files, [&](const auto& a, const auto& b) { return key(a) < key(b); });
  return files;
}

std::string ListingFailure(const std::string& folder) {
  std::error_code failed;
  const std::filesystem::directory_iterator opened(folder, failed);
  const bool is_missing = failed == std::errc::no_such_file_or_directory;
  return failed && !is_missing ? failed.message() : "";
}

bool IsInUse(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return false;
  const bool is_free = flock(file, LOCK_SH | LOCK_NB) == 0;
  close(file);
  return !is_free;
}

}  // namespace collision::wire
