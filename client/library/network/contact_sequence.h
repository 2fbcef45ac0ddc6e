// Whether every contact of a service has come.
#pragma once

#include <cstdint>

namespace collision::client {

/// Follows the numbers of the contacts (CollisionEvent::contacts_sequence). The service counts them
/// from 1, and the network keeps their order, so a gap in what comes is a gap for good.
///
/// What was published before the reader joined is no gap: it begins with the first contact that
/// comes, or with the word that there was none yet. One thread; depends on nothing but the calls.
class ContactSequence {
 public:
  /// The service is another one, which counts from 1. missed() stays.
  void Restart();

  /// The service is one from which `heard` has come before. missed() stays.
  void GoOn(const ContactSequence& heard);

  /// A contact has come. False: it had come before.
  bool Take(std::uint64_t sequence);

  /// The service has published no contact yet.
  void BeginAtNone();

  /// Whether no contact up to this one will come any more.
  bool HasAll(std::uint64_t sequence) const;

  /// The contacts up to this one that have not come were lost. If one comes after all, it is taken,
  /// and does not count as missed any more.
  void GiveUp(std::uint64_t sequence);

  /// Contacts that were lost.
  std::uint64_t missed() const { return missed_; }

 private:
  bool begun_ = false;
  std::uint64_t taken_ = 0;           ///< The highest that has come.
  std::uint64_t given_up_ = 0;        ///< The highest that was given up ...
  std::uint64_t given_up_after_ = 0;  ///< ... with all after this one that have not come.
  std::uint64_t missed_ = 0;
};

}  // namespace collision::client
