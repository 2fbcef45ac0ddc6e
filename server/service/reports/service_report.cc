#include "server/service/reports/service_report.h"

#include <spdlog/spdlog.h>

#include <utility>

#include "idl/limits.h"
#include "server/claim/heard_service.h"
#include "server/config/config_digest.h"
#include "server/process/logging.h"
#include "server/publish/status.h"

namespace collision::server {
ServiceReport::ServiceReport(const v1::Config& complete, std::uint64_t service_id,
                             std::string process)
    : simulated_(complete.clock().kind() != v1::Clock::REAL_TIME),
      configuration_(ConfigurationDigest(complete)),
      service_id_(service_id),
      process_(std::move(process)),
      lease_s_(complete.lease_s()) {}

bool ServiceReport::Hear(const v1::ServiceHeard& heard, std::int64_t now_ns) {
  if (heard.service_id() == service_id_) return fits();
  const auto known = others_.find(heard.service_id());
  if (heard.ended()) {
    if (known == others_.end()) return fits();
    gone_.Add(NameOf(HeardOf(known->second)));
    others_.erase(known);
    return fits();
  }
  if (heard.phase() == v1::PHASE_SERVING) {
    served_ = heard;
    served_ns_ = now_ns;
  }
  if (known == others_.end() && others_.size() == kOthersMax) return fits();
  const v1::ServiceHeard before = std::exchange(others_[heard.service_id()], heard);
  if (heard.phase() == v1::PHASE_CLAIMING || before.phase() == heard.phase()) return fits();
  (heard.phase() == v1::PHASE_SERVING ? serving_ : standbys_).Add(NameOf(HeardOf(heard)));
  if (heard.phase() == v1::PHASE_SERVING && !fits()) {
    misfits_.Add(NameOf(HeardOf(heard)));
  } else if (heard.configuration() != 0 && heard.configuration() != configuration_) {
    configured_otherwise_.Add(NameOf(HeardOf(heard)));
  }
  return fits();
}

bool ServiceReport::HearProgress(const v1::ServiceHeard& heard, std::size_t agents,
                                 Instant newest) {
  if (!readiness_.Hear(heard, agents, newest)) return false;
  spdlog::info("is ready to take over");
  return true;
}

void ServiceReport::Write(const std::vector<std::string>& conflicts, std::int64_t now_ns) {
  for (const std::string& conflict : conflicts) {
    Log(spdlog::level::warn, "two services in one world", conflict);
  }
  for (NamesLog* log : {&gone_, &standbys_, &serving_, &misfits_, &configured_otherwise_})
    log->Write(now_ns);
}

void ServiceReport::LogTakeOver(std::int64_t now_ns) const {
  if (served_.service_id() == 0) return spdlog::info("takes over: no service serves this world");
  spdlog::info(
      "takes over from {}: it has ended, or was not heard for its lease; its last status came "
      "{:.2f} s ago",
      NameOf(HeardOf(served_)), 1e-9 * static_cast<double>(now_ns - served_ns_));
  if (!readiness_.ready()) {
    spdlog::warn("was not ready to take over: what the other one had not told may be lost");
  }
}

bool ServiceReport::MayBegin(std::optional<std::size_t> agents, bool stands_by,
                             std::int64_t now_ns) {
  if (!agents) return false;
  if (!awaits_since_ns_) awaits_since_ns_ = now_ns;
  const bool has_begun = served_.granted_until_ns() != Instant::Always().nanoseconds();
  const bool knows_all = *agents > 0 && served_.service_id() != 0 && (has_begun || !stands_by) &&
                         *agents >= served_.agents();
  if (!knows_all && now_ns - *awaits_since_ns_ < kAwaitOthersNs) return false;
  awaits_since_ns_.reset();
  return true;
}

void ServiceReport::AddExtensions(bool stands_by, std::vector<v1::KeyValue>* extensions) const {
  AddText(std::string(wire::kProcessExtension), process_, extensions);
  AddText("lease_s", fmt::format("{}", lease_s_), extensions);
  if (!stands_by) return;
  const char* const ready = readiness_.ready() ? "ready" : "not ready yet";
  AddText("standby", fits() ? ready : "never: the clocks are of two kinds", extensions);
}

}  // namespace collision::server
