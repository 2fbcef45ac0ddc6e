#include "server/shapes/tree_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "server/process/write_all.h"

namespace collision::server {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEnding = ".tree";
constexpr const char* kAsideEnding = ".aside";

/// Writing a file takes seconds at most: an older one was left behind by a process that died.
constexpr std::chrono::hours kAsideAgeMax{1};

/// Closes what it holds.
class File {
 public:
  explicit File(int descriptor) : descriptor_(descriptor) {}
  ~File() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  int get() const { return descriptor_; }
  bool is_open() const { return descriptor_ >= 0; }
  /// Whether all went well until the end.
  bool Close() { return close(std::exchange(descriptor_, -1)) == 0; }

 private:
  int descriptor_;
};

bool ReadAll(int file, std::string* bytes) {
  std::size_t done = 0;
  while (done < bytes->size()) {
    const ssize_t more = read(file, bytes->data() + done, bytes->size() - done);
    if (more == 0) errno = EIO;
    if (more == 0 || (more < 0 && errno != EINTR)) return false;
    if (more > 0) done += static_cast<std::size_t>(more);
  }
  return true;
}

struct Entry {
  std::int64_t used_ns = 0;
  std::string name;
  std::uint64_t bytes = 0;
};

/// False: there is no regular file.
bool Look(const std::string& path, Entry* entry) {
  struct stat status = {};
  if (lstat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return false;
  entry->bytes = static_cast<std::uint64_t>(status.st_size);
  entry->used_ns = status.st_mtim.tv_sec * std::int64_t{1'000'000'000} + status.st_mtim.tv_nsec;
  return true;
}

/// Regular files of the folder whose name ends so. What vanishes meanwhile is not there.
std::vector<Entry> EntriesOf(const std::string& folder, const std::string& ending) {
  std::vector<Entry> entries;
  std::error_code error;
  for (fs::directory_iterator next(folder, error), end; !error && next != end;
       next.increment(error)) {
    Entry entry{.name = next->path().filename().string()};
    if (!entry.name.ends_with(ending)) continue;
    if (Look(next->path(), &entry)) entries.push_back(std::move(entry));
  }
  return entries;
}

std::int64_t NowNs() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace

TreeFolder::TreeFolder(std::string path, std::uint64_t bytes_max, std::size_t files_max)
    : path_(std::move(path)), bytes_max_(bytes_max), files_max_(files_max) {
  std::error_code error;
  fs::create_directories(path_, error);
  if (!error) fs::directory_iterator(path_, error);
  if (error) throw std::runtime_error(path_ + ": " + error.message());
  RemoveLeftovers();
  List();
  MakeRoom(std::nullopt);
}

void TreeFolder::RemoveLeftovers() const {
  const std::int64_t oldest =
      NowNs() - std::chrono::duration_cast<std::chrono::nanoseconds>(kAsideAgeMax).count();
  for (const Entry& entry : EntriesOf(path_, std::string(kEnding) + kAsideEnding)) {
    if (entry.used_ns < oldest) unlink((path_ + "/" + entry.name).c_str());
  }
}

std::optional<std::string> TreeFolder::Read(const std::string& name, std::string* fault) const {
  fault->clear();
  const std::string path = path_ + "/" + name + kEnding;
  const File file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  if (!file.is_open() && errno == ENOENT) return std::nullopt;
  struct stat status = {};
  if (!file.is_open() || fstat(file.get(), &status) != 0) {
    *fault = "cannot be read: " + CauseOf(errno);
    return std::nullopt;
  }
  const auto bytes = static_cast<std::uint64_t>(status.st_size);
  if (!S_ISREG(status.st_mode) || bytes > bytes_max_) {
    *fault = S_ISREG(status.st_mode) ? std::to_string(bytes) + " bytes; allowed: up to " +
                                           std::to_string(bytes_max_) + " (tree_cache_mb)"
                                     : "not a regular file";
    return std::nullopt;
  }
  std::string content(bytes, '\0');
  if (!ReadAll(file.get(), &content)) {
    *fault = "cannot be read: " + CauseOf(errno);
    return std::nullopt;
  }
  // Marks the file as used now. If that fails, the file is only removed sooner.
  futimens(file.get(), nullptr);
  return content;
}

bool TreeFolder::Write(const std::string& name, const std::string& bytes, std::string* fault) {
  if (bytes.size() > bytes_max_) {
    *fault = std::to_string(bytes.size()) + " bytes; allowed: up to " + std::to_string(bytes_max_) +
             " (tree_cache_mb)";
    return false;
  }
  if (written_ % kWritesPerListing == kWritesPerListing - 1) List();
  Forget(name);
  MakeRoom(bytes.size());
  const std::string path = path_ + "/" + name + kEnding;
  const std::string aside = path_ + "/." + name + "." + std::to_string(getpid()) + "." +
                            std::to_string(++written_) + kEnding + kAsideEnding;
  File file(open(aside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0640));
  const bool is_placed = file.is_open() && WriteAll(file.get(), bytes) == 0 && file.Close() &&
                         rename(aside.c_str(), path.c_str()) == 0;
  Entry entry;
  if (Look(path, &entry)) Note(name, entry.bytes, entry.used_ns);
  if (is_placed) return true;
  *fault = "cannot be written: " + CauseOf(errno);
  unlink(aside.c_str());
  return false;
}

void TreeFolder::List() {
  files_.clear();
  by_use_.clear();
  bytes_ = 0;
  for (const Entry& entry : EntriesOf(path_, kEnding)) {
    Note(entry.name.substr(0, entry.name.size() - std::strlen(kEnding)), entry.bytes,
         entry.used_ns);
  }
}

void TreeFolder::Note(const std::string& name, std::uint64_t bytes, std::int64_t used_ns) {
  Forget(name);
  files_[name] = {bytes, used_ns};
  by_use_.emplace(used_ns, name);
  bytes_ += bytes;
}

void TreeFolder::Forget(const std::string& name) {
  const auto file = files_.find(name);
  if (file == files_.end()) return;
  const auto [bytes, used_ns] = file->second;
  by_use_.erase({used_ns, name});
  bytes_ -= bytes;
  files_.erase(file);
}

void TreeFolder::MakeRoom(std::optional<std::uint64_t> bytes) {
  const std::size_t files = bytes ? 1 : 0;
  while (!by_use_.empty() &&
         (bytes_ + bytes.value_or(0) > bytes_max_ || files_.size() + files > files_max_)) {
    RemoveOrNote(std::string(by_use_.begin()->second));
  }
}

/// A file that was used since it was noted stays for now.
void TreeFolder::RemoveOrNote(const std::string& name) {
  const std::string path = path_ + "/" + name + kEnding;
  Entry entry;
  const bool there = Look(path, &entry);
  if (there && entry.used_ns > files_.at(name).second) {
    return Note(name, entry.bytes, entry.used_ns);
  }
  if (there && unlink(path.c_str()) == 0) ++removed_;
  Forget(name);
}

}  // namespace collision::server
