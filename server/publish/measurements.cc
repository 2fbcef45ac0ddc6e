#include "server/publish/measurements.h"

#include <limits>

namespace collision::server {
namespace {

constexpr std::int64_t kOpen = std::numeric_limits<std::int64_t>::max();

/// Rounded up, as the ends of classes are upper bounds.
std::int64_t MicrosecondsUp(std::int64_t nanoseconds) { return (nanoseconds + 999) / 1000; }

}  // namespace

void Histogram::AddTo(const char* name, v1::ServiceStatus* status) const {
  v1::Histogram& histogram = *status->add_histograms();
  histogram.set_name(name);
  std::size_t size = counts_.size();
  while (size > 0 && counts_[size - 1] == 0) --size;
  for (std::size_t i = 0; i < size; ++i) histogram.add_counts(counts_[i]);
}

void Measurements::BeginStep(std::size_t inputs, std::chrono::nanoseconds waited) {
  measures_ = meter_ != nullptr && inputs > 0;
  if (!measures_) return;
  began_ns_ = ProcessMeter::NowNs();
  arrived_ns_ = began_ns_ - waited.count();
}

void Measurements::EndStep() {
  if (measures_) step_us_.Count(MicrosecondsUp(ProcessMeter::NowNs() - began_ns_));
  measures_ = false;
}

void Measurements::TakeContact(const v1::CollisionEvent& contact) {
  ++leaving_;
  if (contact.status() != v1::EVENT_CONFIRMED || contact.begin().latest_ns() == kOpen) return;
  contact_bracket_ns_.Count(contact.begin().latest_ns() - contact.begin().earliest_ns());
}

void Measurements::ContactsHaveLeft() {
  if (leaving_ > 0 && measures_) {
    const std::int64_t us = MicrosecondsUp(ProcessMeter::NowNs() - arrived_ns_);
    for (; leaving_ > 0; --leaving_) update_to_contact_us_.Count(us);
  }
  leaving_ = 0;
}

void Measurements::AddTo(v1::ServiceStatus* status) const {
  contact_bracket_ns_.AddTo("contact_bracket_ns", status);
  if (meter_ == nullptr) return;
  step_us_.AddTo("step_us", status);
  update_to_contact_us_.AddTo("update_to_contact_us", status);
  status->set_build(BuildText());
  status->set_started_ns(meter_->started_ns());
  status->set_uptime_ns(meter_->uptime_ns());
  const ProcessUsage usage = meter_->Usage();
  status->set_cpu_us(usage.cpu_us);
  status->set_memory_bytes(usage.memory_bytes);
}

}  // namespace collision::server
