#include "server/recording/rolling_files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <vector>

#include "server/process/logging.h"
#include "server/process/write_all.h"

namespace collision::server {
namespace {

constexpr std::int64_t kLookAgainAfter = 60'000'000'000;  // [ns], of wall time
constexpr std::int64_t kMillisecond = 1'000'000;
/// A file that begins so much after now is of a clock that was wrong.
constexpr std::int64_t kFuture = 86'400'000'000'000;  // [ns]
/// Names of one service go up, unless its clock was set back by more.
constexpr std::int64_t kSetBack = 1'000'000'000;  // [ns]
constexpr int kSameTimeMax = 1000;  // Files that several services begin in one millisecond.

bool IsFull(int error_number) { return error_number == ENOSPC || error_number == EDQUOT; }

}  // namespace

bool RollingFiles::Begin(std::int64_t wall_ns) {
  std::error_code failed;
  std::filesystem::create_directories(place_.folder, failed);
  if (failed) return Fail(place_.folder, failed.value());
  DropOld(wall_ns);
  std::int64_t begin_ns = wall_ns;
  if (begun_ns_ >= wall_ns && begun_ns_ - wall_ns < kSetBack) begin_ns = begun_ns_ + kMillisecond;
  for (int later = 0; later < kSameTimeMax; ++later, begin_ns += kMillisecond) {
    const std::string path =
        place_.folder + "/" + wire::KeptFileName(place_.world_and_domain, begin_ns, place_.suffix);
    if (Open(path, O_CREAT | O_EXCL, 0)) {
      begun_ns_ = begin_ns;
      return true;
    }
    if (errno == EEXIST) continue;
    if (!IsFull(errno) || !DropOldest()) break;
  }
  return false;
}

bool RollingFiles::Continue(const wire::KeptFile& file, std::uint64_t bytes) {
  if (!Open(file.path, 0, bytes)) return false;
  if (ftruncate(file_, static_cast<off_t>(bytes)) != 0) {
    Fail(file.path, errno);
    Close();
    return false;
  }
  DropOld(file.begin_ns);
  return true;
}

/// False leaves errno as it was.
bool RollingFiles::Open(const std::string& path, int flags, std::uint64_t bytes) {
  const int file = open(path.c_str(), flags | O_WRONLY | O_CLOEXEC | O_NOFOLLOW, 0644);
  if (file < 0) return Fail(path, errno);
  if (flock(file, LOCK_EX | LOCK_NB) != 0) {
    const int error_number = errno;
    close(file);
    errno = error_number;
    return Fail(path, error_number);
  }
  file_ = file;
  path_ = path;
  bytes_ = bytes;
  return true;
}

bool RollingFiles::Append(const std::string& bytes, std::int64_t wall_ns) {
  if (is_removed()) return Fail(path_, ENOENT);
  const bool is_due = wall_ns - looked_ns_ > kLookAgainAfter || wall_ns < looked_ns_;
  if (is_due || former_bytes_ + bytes_ + bytes.size() > place_.limits.bytes_max) DropOld(wall_ns);
  for (;;) {
    const int error_number = Write(bytes);
    if (error_number == 0) {
      bytes_ += bytes.size();
      return true;
    }
    static_cast<void>(ftruncate(file_, static_cast<off_t>(bytes_)));
    if (!IsFull(error_number) || !DropOldest()) return Fail(path_, error_number);
  }
}

int RollingFiles::Write(const std::string& bytes) {
  if (lseek(file_, static_cast<off_t>(bytes_), SEEK_SET) < 0) return errno;
  return WriteAll(file_, bytes);
}

void RollingFiles::Close() {
  if (file_ >= 0) close(file_);
  file_ = -1;
  bytes_ = 0;
}

void RollingFiles::SetLimits(RollingLimits limits) {
  place_.limits = limits;
  looked_ns_ = 0;  // as long ago as at the start
}

/// The oldest first, but before these the ones that a wrong clock named.
std::vector<wire::KeptFile> RollingFiles::FormerFiles() const {
  std::vector<wire::KeptFile> files = wire::KeptFilesIn(place_.folder, place_.suffix);
  std::erase_if(files, [this](const wire::KeptFile& file) {
    return file.place() != place_.world_and_domain || (is_open() && file.path == path_);
  });
  std::stable_partition(files.begin(), files.end(), [this](const wire::KeptFile& file) {
    return file.begin_ns - kFuture > looked_ns_;
  });
  return files;
}

void RollingFiles::DropOld(std::int64_t wall_ns) {
  looked_ns_ = wall_ns;
  const std::vector<wire::KeptFile> files = FormerFiles();
  former_bytes_ = 0;
  for (const wire::KeptFile& file : files) former_bytes_ += file.bytes;
  std::size_t left = files.size();
  for (std::size_t i = 0; i < files.size(); ++i) {
    // A file ends where the next one begins.
    const bool is_old = place_.limits.keep_ns > 0 && i + 1 < files.size() &&
                        files[i + 1].begin_ns < wall_ns - place_.limits.keep_ns;
    const bool is_too_much =
        former_bytes_ + bytes_ > place_.limits.bytes_max || left >= kRollingFilesMax;
    if (!is_old && !is_too_much) continue;
    if (!wire::IsInUse(files[i].path) && unlink(files[i].path.c_str()) == 0) {
      former_bytes_ -= files[i].bytes;
      --left;
    }
  }
}

bool RollingFiles::DropOldest() {
  for (const wire::KeptFile& file : FormerFiles()) {
    if (wire::IsInUse(file.path) || unlink(file.path.c_str()) != 0) continue;
    Log(spdlog::level::warn, "disk full", "removed " + file.path + ", the oldest, to go on");
    return true;
  }
  return false;
}

bool RollingFiles::Fail(const std::string& path, int error_number) {
  error_ = path + ": cannot be written: " + CauseOf(error_number);
  errno = error_number;
  return false;
}

}  // namespace collision::server
