// Shapes as bytes, as far as their parts have arrived.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "client/programs/scene/payload.h"
#include "idl/messages.pb.h"

namespace collision::client {

/// Gathers parts until a shape is whole and has the hash that it is named by. Any thread.
class ShapeStore {
 public:
  /// Of all shapes together; the bytes of one that does not fit are not kept.
  static constexpr std::size_t kBytesMax = 512 << 20;

  /// Shapes that have come in part; of further ones nothing is kept.
  static constexpr std::size_t kGatheringMax = 4096;

  /// Returns whether that made a shape whole.
  bool Take(const v1::ShapePart& part);

  /// The bytes of a whole shape (idl/shape_bytes.h); null: there is none of this hash.
  Payload Find(const std::string& hash) const;

 private:
  struct Gathering {
    std::vector<std::string> parts;
    std::size_t missing = 0;
  };

  mutable std::mutex mutex_;
  std::map<std::string, Gathering> gathering_;  ///< By hash.
  std::map<std::string, Payload> whole_;        ///< Likewise.
  std::size_t bytes_ = 0;
};

}  // namespace collision::client
