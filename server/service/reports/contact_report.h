// What the service notes of its contacts for people.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "idl/config.pb.h"
#include "server/bus/contact_sink.h"
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

  /// `kept`: gets each contact, too; null: nobody does. Both outlive this.
  ContactReport(Measurements* measurements, ContactSink* kept, const v1::Config& config,
                Write write = WriteToLog)
      : measurements_(*measurements),
        kept_(kept),
        simulated_(config.clock().kind() != v1::Clock::REAL_TIME),
        write_(std::move(write)) {}

  void BeginStep(std::int64_t wall_ns) { wall_ns_ = wall_ns; }
  void TakeContact(const v1::CollisionEvent& contact) override;
  void ContactsHaveLeft() override {
    measurements_.ContactsHaveLeft();
    if (kept_ != nullptr) kept_->Write(wall_ns_);
  }
  /// ContactSink::failure().
  std::string failure() const { return kept_ == nullptr ? "" : kept_->failure(); }

 private:
  /// Of so many contacts at most it is known that they were written. One whose place another took
  /// may be written again when its bracket becomes narrower.
  static constexpr std::size_t kPlaces = 1024;

  Measurements& measurements_;
  ContactSink* const kept_;
  const bool simulated_;
  std::int64_t wall_ns_ = 0;  ///< Of the step.
  const Write write_;
  std::array<std::uint64_t, kPlaces> written_{};  ///< Hashes of contacts, each at its place.
};

}  // namespace collision::server
