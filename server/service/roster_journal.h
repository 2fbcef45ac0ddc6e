// Keeps the roster of the world on file.
#pragma once

#include <functional>
#include <string>

#include "server/claim/journal.h"
#include "server/world/world.h"

namespace collision::server {

/// Writes to the journal who is in the world's epoch, under which run, and how far each may have
/// been granted time (simulated clock). One thread.
///
/// What is written of a grant is `grant_ahead_max_s` more than what was granted, and it is written
/// again only once the grant passes it: some writes a minute instead of one a step. A larger grant
/// on file is safe, because promises of the next service then count from later on: it promises less
/// than it could, never more.
class RosterJournal {
 public:
  /// `journal` may be null: nothing is kept. It outlives this. `open`: opens it when this service
  /// takes over, if another one has it until then (DaemonParts::open_journal); null: not wanted.
  RosterJournal(const v1::Config& config, Journal* journal, std::function<Journal*()> open);

  /// This service has taken over: from now on each Keep() or SetTerm() opens the journal if it is
  /// not open yet, at most once a second, until the service before has let go of it.
  void Open() { opens_ = open_ != nullptr; }

  /// Why it is not open yet; empty: it is, or is not wanted. No failure.
  const std::string& awaited() const { return awaited_; }

  /// Brings the file up to date. Call it before a grant is published. False: that failed, now or
  /// before, and error() says why.
  bool Keep(const World& world);

  /// The term and epoch in force. With a wall clock nobody is waited for: the roster that an
  /// earlier configuration has left behind is removed.
  bool SetTerm(std::uint32_t term, std::uint32_t epoch, std::int64_t monotonic_ns);

  /// One line with path and cause; empty while all is well.
  const std::string& error() const;

 private:
  void TryToOpen(std::int64_t monotonic_ns);
  void WriteTerm();
  bool KeepOne(const Simulator& simulator);

  Journal* journal_;
  const std::function<Journal*()> open_;
  const bool has_roster_;
  bool opens_ = false;
  std::int64_t next_try_ns_ = 0;
  std::uint32_t term_ = 0, epoch_ = 0;  ///< In force; 0: not yet.
  std::string awaited_;
  std::string failure_;         ///< Why it cannot be opened.
  const double written_ahead_;  ///< [s]
};

}  // namespace collision::server
