// How long things take and how narrow brackets are, as histograms of the status.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "idl/histogram.h"
#include "idl/messages.pb.h"
#include "server/process/process_meter.h"

namespace collision::server {

/// How many values fell into each class of a Histogram of collision.idl.
class Histogram {
 public:
  void Count(std::int64_t value) { ++counts_[wire::ClassOf(value)]; }

  /// Appends it, up to its last class that is not empty.
  void AddTo(const char* name, v1::ServiceStatus* status) const;

 private:
  std::array<std::uint64_t, wire::kHistogramCountsMax> counts_{};
};

/// What a service measures of itself. Without a meter it measures no time. One thread.
class Measurements {
 public:
  /// `meter` may be null; it outlives this.
  explicit Measurements(const ProcessMeter* meter) : meter_(meter) {}

  /// A step begins; the oldest of its inputs has waited so long. Steps without inputs are
  /// not measured.
  void BeginStep(std::size_t inputs, std::chrono::nanoseconds waited);
  void EndStep();

  /// A contact is published.
  void TakeContact(const v1::CollisionEvent& contact);
  /// Those published so far have been handed to the network.
  void ContactsHaveLeft();

  /// The histograms, and what the process has used.
  void AddTo(v1::ServiceStatus* status) const;

 private:
  const ProcessMeter* const meter_;
  bool measures_ = false;  ///< This step.
  std::int64_t began_ns_ = 0, arrived_ns_ = 0;
  std::size_t leaving_ = 0;  ///< Contacts that have not left.
  Histogram step_us_, update_to_contact_us_, contact_bracket_ns_;
};

}  // namespace collision::server
