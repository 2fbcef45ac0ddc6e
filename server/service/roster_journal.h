// Keeps the roster of the world on file.
#pragma once

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
  RosterJournal(const v1::Config& config, JournalParts parts);

  /// This service has taken over: from now on each Keep() or SetTerm() opens the journal if it is
  /// not open yet, at most once a second, until the service before has let go of it.
  void Open() { opens_ = parts_.open != nullptr; }

  /// Why it is not open yet; empty: it is, or is not wanted. No failure.
  const std::string& awaited() const { return awaited_; }

  /// Brings the file up to date. Call it before a grant is published. False: that failed, now or
  /// before, and the service is to end (on_state_failure).
  bool Keep(const World& world);

  /// The term and epoch in force. With a wall clock nobody is waited for: the roster that an
  /// earlier configuration has left behind is removed.
  void SetTerm(std::uint32_t term, std::uint32_t epoch, std::int64_t monotonic_ns);

  /// Why nothing is kept, although that is wanted: one line with path and cause, logged once; empty
  /// while all is well.
  const std::string& failure() const { return parts_.failure; }

 private:
  void TryToOpen(std::int64_t monotonic_ns);
  void WriteTerm();
  bool KeepOne(const Simulator& simulator);
  void Fail(const std::string& why);
  bool GoesOn();

  JournalParts parts_;
  const bool has_roster_;
  const bool goes_on_without_;
  bool opens_ = false;
  std::int64_t next_try_ns_ = 0;
  std::uint32_t term_ = 0, epoch_ = 0;  ///< In force; 0: not yet.
  std::string awaited_;
  const double written_ahead_;  ///< [s]
};

}  // namespace collision::server
