#include "client/library/world/service_echo.h"

namespace collision::client {

void ServiceEcho::Hear(const v1::ServiceStamp& stamp, std::int64_t now_ns, std::int64_t heard_ns) {
  const bool same = stamp.service_id() == service_id_ && stamp.epoch() == epoch_;
  // Of several samples of one time the first has come the fastest way.
  if (same && now_ns <= now_ns_) return;
  service_id_ = stamp.service_id();
  epoch_ = stamp.epoch();
  now_ns_ = now_ns;
  heard_ns_ = heard_ns;
}

void ServiceEcho::FillIn(std::int64_t sent_ns, v1::SimulatorClock* clock) const {
  clock->set_service_id(service_id_);
  clock->set_epoch(epoch_);
  clock->set_echo_ns(now_ns_);
  clock->set_heard_ns(heard_ns_);
  clock->set_sent_ns(sent_ns);
}

}  // namespace collision::client
