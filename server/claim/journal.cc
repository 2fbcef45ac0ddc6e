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
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "collision_core/base/check.h"
#include "idl/identity.h"
#include "idl/limits.h"
#include "server/process/write_all.h"

namespace collision::server {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t kRecordBytes = 128;
constexpr std::size_t kPayloadBytes = kRecordBytes - sizeof(std::uint64_t);
constexpr char kInUse[] = ": in use: another collisiond serves this world";
constexpr char kMagic[8] = {'C', 'J', 'O', 'U', 'R', 'N', 'A', 1};

struct Head {
  char magic[sizeof(kMagic)];
  std::uint32_t term;
  std::uint32_t epoch;
  std::uint32_t rows;  // that the file has at least; it grows after the row is written
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

/// The file, open and locked; -1: there is none, and `flags` do not make one.
int OpenLocked(const std::string& path, int flags) {
  const int file = open(path.c_str(), flags | O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0644);
  if (file < 0 && errno == ENOENT && (flags & O_CREAT) == 0) return -1;
  if (file < 0) Fail(path, "cannot be written: " + CauseOf(errno));
  struct stat facts {};
  const bool regular = fstat(file, &facts) == 0 && S_ISREG(facts.st_mode);
  if (regular && flock(file, LOCK_EX | LOCK_NB) == 0) return file;
  const int error_number = errno;
  close(file);
  if (!regular) Fail(path, "is no regular file");
  if (error_number != EWOULDBLOCK) Fail(path, "cannot be locked: " + CauseOf(error_number));
  throw JournalInUse(path + kInUse);
}

}  // namespace

Journal::Journal(const std::string& folder, const std::string& world, std::uint32_t domain,
                 std::size_t simulators_max)
    : simulators_max_(simulators_max),
      path_(fmt::format("{}/{}.{}.journal", folder, world, domain)) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) Fail(folder, "cannot be made: " + failure.message());
  try {
    file_ = OpenLocked(path_, 0);
    if (file_ < 0) Begin();
    Read();
  } catch (...) {
    close(file_);
    throw;
  }
}

Journal::~Journal() { close(file_); }

/// Under another name until its head is on the medium: so an empty file is a damaged journal.
void Journal::Begin() {
  const std::string unfinished = path_ + ".new";
  file_ = OpenLocked(unfinished, O_CREAT);
  if (access(path_.c_str(), F_OK) == 0) {
    unlink(unfinished.c_str());
    throw JournalInUse(path_ + kInUse);
  }
  const bool empty = ftruncate(file_, 0) == 0;
  if (empty && WriteHead() && fsync(file_) == 0 && rename(unfinished.c_str(), path_.c_str()) == 0) {
    return;
  }
  const std::string cause = CauseOf(errno);
  unlink(unfinished.c_str());
  if (!error_.empty()) throw std::runtime_error(error_);
  Fail(path_, "cannot be made: " + cause);
}

void Journal::Read() {
  struct stat facts {};
  std::string bytes((1 + simulators_max_) * kRecordBytes, '\0');
  const ssize_t size = pread(file_, bytes.data(), bytes.size(), 0);
  if (size < 0 || fstat(file_, &facts) != 0) Fail(path_, "cannot be read: " + CauseOf(errno));
  bytes.resize(static_cast<std::size_t>(size));
  if (!bytes.empty() && bytes.compare(0, sizeof kMagic, kMagic, sizeof kMagic) != 0) {
    Fail(path_, "byte 0: not a journal of this version; move it away to begin anew");
  }
  for (std::size_t record = 0; record * kRecordBytes < bytes.size(); ++record) {
    ReadRecord(record, bytes.substr(record * kRecordBytes, kRecordBytes));
  }
  const auto file_bytes = static_cast<std::size_t>(facts.st_size);
  const std::size_t found = (file_bytes + kRecordBytes - 1) / kRecordBytes;
  if (found == 0) AddDamage(0, "the file is empty: the term and all simulators are lost");
  if (found > 0 && found < 1 + rows_) {
    AddDamage(file_bytes,
              fmt::format("the file ends here, {} records too early", 1 + rows_ - found));
  }
  const std::size_t rows_found = std::max<std::size_t>(found, 1) - 1;
  rows_ = std::min(rows_, rows_found);
  CountBeyond();
  rows_ = std::max(rows_, std::min(rows_found, simulators_max_));
  std::vector<bool> taken(1 + simulators_max_);
  for (const auto& [id, record] : record_of_) taken[record] = true;
  for (std::size_t record = simulators_max_; record > 0; --record) {
    if (!taken[record]) free_.push_back(record);
  }
}

void Journal::ReadRecord(std::size_t record, const std::string& bytes) {
  if (bytes.size() < kRecordBytes || !Fits(record, bytes)) {
    AddDamage(record * kRecordBytes, fmt::format("{} does not fit its checksum",
                                                 record == 0 ? "the term" : "a simulator"));
    if (record > 0) spoilt_.push_back(record);
    return;
  }
  if (record == 0) {
    const Head head = FromPayload<Head>(bytes);
    term_ = head.term;
    epoch_ = head.epoch;
    rows_ = head.rows;
    return;
  }
  const Row row = FromPayload<Row>(bytes);
  if (row.name_length == 0 || row.name_length > wire::kNameMax) return;
  Take(SimulatorOf(row), record);
}

void Journal::Take(const JournalledSimulator& simulator, std::size_t record) {
  const auto [known, is_new] = simulators_.try_emplace(simulator.id, simulator);
  std::size_t& place = record_of_.try_emplace(simulator.id, record).first->second;
  if (is_new) return;
  AddDamage(record * kRecordBytes, fmt::format("simulator \"{}\" has another record before this "
                                               "one: the higher run and grant counts",
                                               simulator.name));
  const auto reach = [](const JournalledSimulator& of) { return std::pair(of.run, of.granted); };
  if (reach(simulator) > reach(known->second)) {
    known->second = simulator;
    std::swap(place, record);
  }
  spoilt_.push_back(record);
}

void Journal::CountBeyond() {
  std::size_t simulators = 0;
  for (std::size_t record = 1 + simulators_max_; record <= rows_; ++record) {
    std::string bytes(kRecordBytes, '\0');
    const auto place = static_cast<off_t>(record * kRecordBytes);
    if (pread(file_, bytes.data(), bytes.size(), place) != static_cast<ssize_t>(bytes.size()))
      break;
    if (Fits(record, bytes) && FromPayload<Row>(bytes).name_length == 0) continue;
    spoilt_.push_back(record);
    ++simulators;
  }
  if (simulators == 0) return;
  AddDamage((1 + simulators_max_) * kRecordBytes,
            fmt::format("simulators beyond simulators_max, which was larger: {}", simulators));
}

void Journal::AddDamage(std::size_t byte, const std::string& what) {
  damage_.push_back(fmt::format("{}: byte {}: {}", path_, byte, what));
}

bool Journal::Write(std::size_t record, const std::string& payload) {
  if (!error_.empty()) return false;
  if (IsRemoved(file_)) {
    error_ = fmt::format("{}: was removed", path_);
    return false;
  }
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
  head.rows = static_cast<std::uint32_t>(rows_);
  return Write(0, PayloadOf(head));
}

bool Journal::SetTerm(std::uint32_t term, std::uint32_t epoch) {
  term_ = term;
  epoch_ = epoch;
  for (const std::size_t record : std::exchange(spoilt_, {})) {
    const auto holds = [&](const auto& entry) { return entry.second == record; };
    if (std::ranges::none_of(record_of_, holds)) Write(record, PayloadOf(Row{}));
  }
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
  if (!Write(record->second, PayloadOf(RowOf(simulator)))) return false;
  if (record->second <= rows_) return true;
  rows_ = record->second;
  return WriteHead();
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
