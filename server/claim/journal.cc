#include "server/claim/journal.h"

#include <fcntl.h>
#include <spdlog/fmt/fmt.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "collision_core/base/check.h"
#include "idl/identity.h"
#include "idl/limits.h"
#include "server/process/write_all.h"

namespace collision::server {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t kRecordBytes = 128;
constexpr std::size_t kPayloadBytes = kRecordBytes - sizeof(std::uint64_t);
constexpr char kMagic[8] = {'C', 'J', 'O', 'U', 'R', 'N', 'A', 1};

struct Head {
  char magic[sizeof(kMagic)];
  std::uint32_t term;
  std::uint32_t epoch;
};

struct Row {
  std::uint64_t id;
  std::int64_t granted_ns;
  std::uint32_t run;
  std::uint16_t is_granted;
  std::uint16_t name_length;  // 0: the record is free
  char name[wire::kNameMax];
};
static_assert(sizeof(Row) <= kPayloadBytes);

template <typename Plain>
std::string PayloadOf(const Plain& plain) {
  std::string payload(kPayloadBytes, '\0');
  std::memcpy(payload.data(), &plain, sizeof plain);
  return payload;
}

template <typename Plain>
Plain FromPayload(const std::string& payload) {
  Plain plain;
  std::memcpy(&plain, payload.data(), sizeof plain);
  return plain;
}

/// With its place, so that a record that was written to the wrong one does not fit.
std::uint64_t Checksum(std::size_t record, const std::string& payload) {
  return Fnv1a(payload + std::to_string(record));
}

bool Fits(std::size_t record, const std::string& bytes) {
  std::uint64_t checksum = 0;
  std::memcpy(&checksum, bytes.data() + kPayloadBytes, sizeof checksum);
  return checksum == Checksum(record, bytes.substr(0, kPayloadBytes));
}

[[noreturn]] void Fail(const std::string& path, const std::string& what) {
  throw std::runtime_error(path + ": " + what);
}

Row RowOf(const JournalledSimulator& simulator) {
  Row row{};
  row.id = simulator.id;
  row.granted_ns = simulator.granted.value_or(Instant()).nanoseconds();
  row.run = simulator.run;
  row.is_granted = simulator.granted.has_value();
  row.name_length = static_cast<std::uint16_t>(simulator.name.size());
  std::memcpy(row.name, simulator.name.data(), simulator.name.size());
  return row;
}

JournalledSimulator SimulatorOf(const Row& row) {
  JournalledSimulator simulator;
  simulator.id = row.id;
  simulator.run = row.run;
  simulator.name.assign(row.name, row.name_length);
  if (row.is_granted != 0) simulator.granted = Instant::FromNanoseconds(row.granted_ns);
  return simulator;
}

}  // namespace

Journal::Journal(const std::string& folder, const std::string& world, std::uint32_t domain,
                 std::size_t simulators_max)
    : simulators_max_(simulators_max),
      path_(fmt::format("{}/{}.{}.journal", folder, world, domain)) {
  Open(folder);
  try {
    Read();
  } catch (...) {
    close(file_);
    throw;
  }
}

Journal::~Journal() { close(file_); }

void Journal::Open(const std::string& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) Fail(folder, "cannot be made: " + failure.message());
  file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0644);
  if (file_ < 0) Fail(path_, "cannot be written: " + CauseOf(errno));
  struct stat facts {};
  const bool regular = fstat(file_, &facts) == 0 && S_ISREG(facts.st_mode);
  if (regular && flock(file_, LOCK_EX | LOCK_NB) == 0) return;
  const int error_number = errno;
  close(file_);
  if (!regular) Fail(path_, "is no regular file");
  if (error_number != EWOULDBLOCK) Fail(path_, "cannot be locked: " + CauseOf(error_number));
  throw JournalInUse(path_ + ": in use: another collisiond serves this world");
}

void Journal::Read() {
  std::string bytes((1 + simulators_max_) * kRecordBytes, '\0');
  const ssize_t size = pread(file_, bytes.data(), bytes.size(), 0);
  if (size < 0) Fail(path_, "cannot be read: " + CauseOf(errno));
  bytes.resize(static_cast<std::size_t>(size));
  // An empty file is a new journal, or one that ended before its first write.
  if (bytes.empty() && !WriteHead()) throw std::runtime_error(error_);
  if (!bytes.empty() && bytes.compare(0, sizeof kMagic, kMagic, sizeof kMagic) != 0) {
    Fail(path_, "byte 0: not a journal of this version; move it away to begin anew");
  }
  for (std::size_t record = 0; record * kRecordBytes < bytes.size(); ++record) {
    const std::string one = bytes.substr(record * kRecordBytes, kRecordBytes);
    if (one.size() < kRecordBytes || !Fits(record, one)) {
      damage_.push_back(fmt::format("{}: byte {}: {} does not fit its checksum and is left out",
                                    path_, record * kRecordBytes,
                                    record == 0 ? "the term" : "a simulator"));
      continue;
    }
    if (record == 0) {
      const Head head = FromPayload<Head>(one);
      term_ = head.term;
      epoch_ = head.epoch;
      continue;
    }
    const Row row = FromPayload<Row>(one);
    if (row.name_length == 0 || row.name_length > wire::kNameMax) continue;
    simulators_[row.id] = SimulatorOf(row);
    record_of_[row.id] = record;
  }
  std::vector<bool> taken(1 + simulators_max_);
  for (const auto& [id, record] : record_of_) taken[record] = true;
  for (std::size_t record = simulators_max_; record > 0; --record) {
    if (!taken[record]) free_.push_back(record);
  }
}

bool Journal::Write(std::size_t record, const std::string& payload) {
  if (!error_.empty()) return false;
  const std::uint64_t checksum = Checksum(record, payload);
  std::string bytes = payload;
  bytes.append(reinterpret_cast<const char*>(&checksum), sizeof checksum);
  const auto place = static_cast<off_t>(record * kRecordBytes);
  const ssize_t written = pwrite(file_, bytes.data(), bytes.size(), place);
  if (written == static_cast<ssize_t>(bytes.size())) return true;
  error_ = fmt::format("{}: byte {}: cannot be written: {}", path_, place,
                       CauseOf(written < 0 ? errno : ENOSPC));
  return false;
}

bool Journal::WriteHead() {
  Head head{};
  std::copy(std::begin(kMagic), std::end(kMagic), head.magic);
  head.term = term_;
  head.epoch = epoch_;
  return Write(0, PayloadOf(head));
}

bool Journal::SetTerm(std::uint32_t term, std::uint32_t epoch) {
  term_ = term;
  epoch_ = epoch;
  return WriteHead();
}

bool Journal::Put(const JournalledSimulator& simulator) {
  CORE_CHECK(!simulator.name.empty() && simulator.name.size() <= wire::kNameMax,
             "a simulator of the roster has a name", simulator.name.size());
  auto record = record_of_.find(simulator.id);
  if (record == record_of_.end()) {
    CORE_CHECK(!free_.empty(), "the roster has no more simulators than the world", simulators_max_);
    record = record_of_.try_emplace(simulator.id, free_.back()).first;
    free_.pop_back();
  } else if (simulators_.at(simulator.id) == simulator) {
    return error_.empty();
  }
  simulators_[simulator.id] = simulator;
  return Write(record->second, PayloadOf(RowOf(simulator)));
}

bool Journal::Remove(std::uint64_t id) {
  const auto record = record_of_.find(id);
  if (record == record_of_.end()) return error_.empty();
  const bool written = Write(record->second, PayloadOf(Row{}));
  free_.push_back(record->second);
  record_of_.erase(record);
  simulators_.erase(id);
  return written;
}

bool Journal::RemoveAll() {
  while (!simulators_.empty()) Remove(simulators_.begin()->first);
  return error_.empty();
}

}  // namespace collision::server
