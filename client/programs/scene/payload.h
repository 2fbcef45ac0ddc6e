// Bytes that several viewers share.
#pragma once

#include <memory>
#include <string>
#include <utility>

namespace collision::client {

using Payload = std::shared_ptr<const std::string>;

inline Payload MakePayload(std::string bytes) {
  return std::make_shared<const std::string>(std::move(bytes));
}

}  // namespace collision::client
