#include "client/library/network/arrival_order.h"

#include <algorithm>

namespace collision::client {

void OrderEvents(std::vector<v1::Output>* outputs) {
  const auto stamp = [](const v1::Output& output) -> const v1::ServiceStamp& {
    return output.collision_event().stamp();
  };
  auto from = std::stable_partition(outputs->begin(), outputs->end(), [](const v1::Output& output) {
    return !output.has_collision_event();
  });
  while (from != outputs->end()) {
    const std::uint64_t service = stamp(*from).service_id();
    const auto end = std::find_if(from, outputs->end(), [&](const v1::Output& output) {
      return stamp(output).service_id() != service;
    });
    std::stable_sort(from, end, [&](const v1::Output& a, const v1::Output& b) {
      return stamp(a).sequence() < stamp(b).sequence();
    });
    from = end;
  }
}

}  // namespace collision::client
