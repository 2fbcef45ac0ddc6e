#include "client/library/network/current_service.h"

namespace collision::client {

bool CurrentService::Accept(const v1::ServiceStamp& stamp, Time now) {
  if (stamp.service_id() != id_) {
    const bool goes_first = stamp.term() != term_ ? stamp.term() > term_ : stamp.service_id() < id_;
    const bool silent = now - heard_ >= kServiceSilence;
    if (id_ != 0 && !goes_first && !silent) {
      ++conflicts_;
      return false;
    }
    if (id_ != 0) ++changes_;
    id_ = stamp.service_id();
  } else if (IsPast(stamp)) {
    return false;
  }
  term_ = stamp.term();
  epoch_ = stamp.epoch();
  heard_ = now;
  return true;
}

}  // namespace collision::client
