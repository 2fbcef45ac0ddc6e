#include "server/service/reports/silence_report.h"

#include <algorithm>

#include "idl/limits.h"
#include "server/publish/text/names_text.h"

namespace collision::server {

SilenceReport::SilenceReport(bool releases)
    : silent_(
          "world time waits for simulator {}: it is not heard: its process has ended, or stands "
          "still; start it again or let it go on, or evict it with collisionctl evict" +
          std::string(releases ? "; clock.release_after_s ends the waiting"
                               : " (or set clock.on_silent_simulator to RELEASE)")) {}

bool SilenceReport::TakeWaited(const std::vector<Awaited>& waited) {
  if (waited == waited_) return false;
  for (const Awaited& one : waited) {
    if (std::find(waited_.begin(), waited_.end(), one) != waited_.end()) continue;
    switch (one.reason) {
      case WaitReason::kEnded:
        silent_.Add(one.name);
        break;
      case WaitReason::kStands:
        stands_.Add(one.name);
        break;
      case WaitReason::kHasNoClock:
        without_clock_.Add(one.name);
        break;
      case WaitReason::kDoesNotFollowYet:
        not_following_.Add(one.name);
        break;
      case WaitReason::kMissing:
        missing_.Add(one.name);
        break;
    }
  }
  waited_ = waited;
  return true;
}

void SilenceReport::AddReleased(const std::vector<std::string>& names) {
  for (const std::string& name : names) releases_.Add(name);
}

void SilenceReport::AddRemoved(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    removals_.Add(name);
    removed_.insert(removed_.begin(), name);
    if (removed_.size() > kRemovedShownMax) removed_.pop_back();
  }
}

void SilenceReport::Write(std::int64_t monotonic_ns) {
  for (NamesLog* log :
       {&silent_, &stands_, &without_clock_, &not_following_, &missing_, &releases_, &removals_}) {
    log->Write(monotonic_ns);
  }
}

void SilenceReport::AddExtensions(std::vector<v1::KeyValue>* extensions) const {
  if (removed_.empty()) return;
  v1::KeyValue& extension = extensions->emplace_back();
  extension.set_key("removed_silent");
  extension.set_value(NamesText(removed_, wire::kExtensionValueMax));
}

}  // namespace collision::server
