// What a service must remember when it is started again.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "server/claim/journalled_simulator.h"

namespace collision::server {

/// Another process has the journal open: it serves the world, or is about to.
class JournalInUse : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A small file in the state directory: the term, the epoch and, of the simulators that hold time,
/// run and greatest grant. One process has it open at a time.
///
/// **Form.** Records of 128 bytes: first the head, then one for each simulator of the roster, in
/// any order, at most `simulators_max`. Each ends with a checksum. A record is overwritten in place
/// by one write of the operating system: a process that is killed leaves it whole, old or new. A
/// machine that loses its power may lose what its page cache holds: the last seconds, or one record
/// that does not fit its checksum. It is of the machine that wrote it (little-endian).
///
/// **Damage.** What does not fit its checksum, what is missing at the end, and simulators beyond
/// `simulators_max` are left out and told by damage(); nothing else is lost. So are records of a
/// simulator that has another one, of a higher run, or of the same run and a greater grant: a
/// machine that lost its power may have kept the old record beside the new one. A journal is given
/// its name only once its head is on the medium, so an empty file is a damaged one. The next
/// SetTerm() frees the records that were left out.
///
/// **Failure.** A write that fails (a full disk, a medium gone read-only, a file that somebody has
/// removed) is told by error(), and nothing more is written. One thread.
class Journal {
 public:
  /// Opens the journal of a world, or begins one, and makes `folder` if it is missing. Throws
  /// JournalInUse, or another std::runtime_error with path and cause: it cannot be written, or is
  /// no journal.
  Journal(const std::string& folder, const std::string& world, std::uint32_t domain,
          std::size_t simulators_max);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  const std::string& path() const { return path_; }
  std::uint32_t term() const { return term_; }    ///< 0: none was ever written.
  std::uint32_t epoch() const { return epoch_; }  ///< Likewise.

  /// The roster, by id.
  const std::map<std::uint64_t, JournalledSimulator>& simulators() const { return simulators_; }

  /// Whether the roster has no room for another simulator.
  bool full() const { return free_.empty(); }

  /// What was left out when it was opened, a line each, with path and byte.
  const std::vector<std::string>& damage() const { return damage_; }

  /// All are on file when they return; false: they are not, and error() says why.
  bool SetTerm(std::uint32_t term, std::uint32_t epoch);
  bool Put(const JournalledSimulator& simulator);
  bool Remove(std::uint64_t id);
  bool RemoveAll();

  /// One line with path and cause of the first write that failed; empty while all is well.
  const std::string& error() const { return error_; }

 private:
  void Begin();
  void Read();
  void ReadRecord(std::size_t record, const std::string& bytes);
  void Take(const JournalledSimulator& simulator, std::size_t record);
  void CountBeyond();
  void AddDamage(std::size_t byte, const std::string& what);
  bool Write(std::size_t record, const std::string& payload);
  bool WriteHead();

  const std::size_t simulators_max_;
  std::string path_;
  int file_ = -1;
  std::uint32_t term_ = 0;
  std::uint32_t epoch_ = 0;
  std::map<std::uint64_t, JournalledSimulator> simulators_;
  std::map<std::uint64_t, std::size_t> record_of_;  ///< By simulator.
  std::vector<std::size_t> free_;                   ///< Records without a simulator, last first.
  std::size_t rows_ = 0;                            ///< Records after the head that the file has.
  std::vector<std::size_t> spoilt_;  ///< Of these, those that are left out, until SetTerm().
  std::vector<std::string> damage_;
  std::string error_;
};

/// How a service gets its journal.
struct JournalParts {
  Journal* journal = nullptr;  ///< Null: there is none, or not yet. It outlives what uses it.
  /// Opens it when this service takes over, if another one has it until then. Throws JournalInUse
  /// as long as that one has it, std::runtime_error if it cannot be opened. Null: not wanted.
  std::function<Journal*()> open = nullptr;
  std::string failure = {};  ///< Why there is none, if one was wanted.
};

}  // namespace collision::server
