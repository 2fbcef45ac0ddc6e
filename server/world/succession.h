// Messages of processes that wait for the id of a simulator whose process still lives.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "idl/messages.pb.h"

namespace collision::server {

/// Messages that are held for the successors of one simulator.
inline constexpr std::size_t kHeldInputsMax = 4096;

/// Messages that successors wrote before they took over, by simulator, in the order of arrival.
///
/// A process that is restarted may write before the lease of its predecessor is over. A sample of a
/// transient-local topic is delivered once, so what it writes is held and applied when the
/// predecessor is gone. One thread.
class Succession {
 public:
  /// Whether messages are held for the id.
  bool IsAwaited(std::uint64_t simulator) const { return held_.contains(simulator); }

  /// Whether `sender` waits for the id.
  bool Waits(std::uint64_t simulator, std::uint64_t sender) const;

  /// Holds a message; beyond kHeldInputsMax for one id it is dropped.
  void Hold(std::uint64_t simulator, const v1::Input& input);

  /// Holds a removal, in place of the newest message if there is no room: no removal is lost.
  void HoldRemoval(std::uint64_t simulator, const v1::Input& removal);

  /// `sender` is gone: what it wrote for the id must not be applied.
  void Drop(std::uint64_t simulator, std::uint64_t sender);

  /// Hands out what is held for the id.
  [[nodiscard]] std::vector<v1::Input> Take(std::uint64_t simulator);

  /// Bytes of parts of shapes that are held, of all ids.
  std::uint64_t shape_bytes() const { return shape_bytes_; }

 private:
  void CountBytes();

  std::map<std::uint64_t, std::vector<v1::Input>> held_;  ///< By simulator; none is empty.
  std::uint64_t shape_bytes_ = 0;
};

}  // namespace collision::server
