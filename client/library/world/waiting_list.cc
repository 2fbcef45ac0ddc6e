#include "client/library/world/waiting_list.h"

#include <algorithm>

#include "idl/limits.h"

namespace collision::client {

void WaitingList::Take(const v1::ServiceStatus& status) {
  names_.clear();
  for (const v1::KeyValue& extension : status.extensions()) {
    if (extension.key() != "waiting_for") continue;
    const std::string& text = extension.value();
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find(", ", begin), text.size());
      const std::string name = text.substr(begin, end - begin);
      // How many do not fit is no name: "+7 more". A shape is "shape 1a2b3c4d".
      if (wire::IsName(name) || name.starts_with("shape ")) names_.push_back(name);
      begin = end + 2;
    }
  }
}

bool WaitingList::TakeChange() {
  if (names_ == told_) return false;
  told_ = names_;
  return true;
}

}  // namespace collision::client
