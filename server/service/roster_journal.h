// Keeps the roster of the world on file.
#pragma once

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
  /// `journal` may be null: nothing is kept. It outlives this.
  RosterJournal(const v1::Config& config, Journal* journal);

  /// Keeps it there from now on.
  void Use(Journal* journal) { journal_ = journal; }

  /// Brings the file up to date. Call it before a grant is published. False: that failed, now or
  /// before, and error() says why.
  bool Keep(const World& world);

  /// Empties the roster.
  bool Clear();

  /// The term and epoch in force.
  bool SetTerm(std::uint32_t term, std::uint32_t epoch);

  /// One line with path and cause; empty while all is well.
  const std::string& error() const;

 private:
  bool KeepOne(const Simulator& simulator);

  Journal* journal_;
  const double written_ahead_;  ///< [s]
};

}  // namespace collision::server
