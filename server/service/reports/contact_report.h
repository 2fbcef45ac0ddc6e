// What the service notes of its contacts for people.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "server/publish/measurements.h"
#include "server/publish/publisher.h"

namespace collision::server {

/// "fleet/a and fleet/b touch, from between 1.25 s and 1.26 s"; of a level its name, too. Times of
/// a wall clock as UTC.
std::string ContactText(const v1::CollisionEvent& contact, bool simulated_clock);

/// Writes a line when a contact is confirmed, once for each, and measures all that are published.
/// One thread.
class ContactReport final : public ContactObserver {
 public:
  using Write = std::function<void(const std::string& text)>;

  /// To the log, at most one line a second.
  static void WriteToLog(const std::string& text);

  /// `measurements` outlives this.
  ContactReport(Measurements* measurements, bool simulated_clock, Write write = WriteToLog)
      : measurements_(*measurements), simulated_(simulated_clock), write_(std::move(write)) {}

  void TakeContact(const v1::CollisionEvent& contact) override;
  void ContactsHaveLeft() override { measurements_.ContactsHaveLeft(); }

  /// Contacts of which it is known that they were written: beyond, all are forgotten, and may be
  /// written again when their bracket becomes narrower.
  static constexpr std::size_t kWrittenMax = 4096;

 private:
  /// Simulator, run, slot, generation of both; the ordinal of the contact; the level.
  using Agent = std::tuple<std::uint64_t, std::uint32_t, std::uint32_t, std::uint32_t>;
  using Contact = std::tuple<Agent, Agent, std::uint32_t, std::string>;

  Measurements& measurements_;
  const bool simulated_;
  const Write write_;
  std::set<Contact> written_;
};

}  // namespace collision::server
