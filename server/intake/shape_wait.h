// The shapes for which a world in lock-step waits.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace collision::server {

/// Waiting for a shape is worth a line in the log after so long [ns].
inline constexpr std::int64_t kShapeWaitTold = 1'000'000'000;

/// Shapes that agents refer to and whose wanted trees are not there. How long it takes to send a
/// shape and to build its tree depends on network and machine, so the world's time stands still
/// meanwhile: otherwise it would be chance from when on the shape counts. After a limit time goes
/// on without it. Times are nanoseconds of the monotonic clock. One thread.
class ShapeWait {
 public:
  explicit ShapeWait(std::int64_t limit_ns) : limit_ns_(limit_ns) {}

  /// An agent refers to this shape; nothing changes if it is waited for already.
  void Begin(const std::string& hash, std::int64_t now_ns) { waits_.try_emplace(hash, now_ns); }

  /// It is there, or will never be, or nobody refers to it any more.
  void End(const std::string& hash) { waits_.erase(hash); }

  /// Whether any shape is missing that has not been waited for too long.
  bool Holds(std::int64_t now_ns) const;

  /// When Holds() may change although no shape comes, or a line is due; nullopt: never.
  std::optional<std::int64_t> NextDue() const;

  /// Lines for the log: of each shape when it has been waited for for a while, and at its limit.
  [[nodiscard]] std::vector<std::string> TakeLines(std::int64_t now_ns);

  /// Those that hold time, for the status.
  std::vector<std::string> Waiting(std::int64_t now_ns) const;

 private:
  struct Wait {
    explicit Wait(std::int64_t since) : since_ns(since) {}
    std::int64_t since_ns;
    bool told = false;
    bool given_up = false;
  };

  const std::int64_t limit_ns_;
  std::map<std::string, Wait> waits_;  ///< By hash.
};

}  // namespace collision::server
