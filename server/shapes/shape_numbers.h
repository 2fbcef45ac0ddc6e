// Which shape a simulator means by a number.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace collision::server {

/// The numbers that simulators give their shapes, each the name of one content as long as the
/// simulator holds anything of it. A content that comes under a second number has that one alone:
/// the removal of the first is late. A key of the network has at most 16 bytes, so a part of a
/// shape cannot be named by its hash there. One thread.
class ShapeNumbers {
 public:
  /// The hash of the shape that this simulator calls `number`; null: it has none.
  const std::string* HashOf(std::uint64_t simulator, std::uint32_t number) const;

  /// Requires that the number has no other content.
  void Set(std::uint64_t simulator, std::uint32_t number, const std::string& hash);

  /// The simulator's number of this shape, if it has one, is free again.
  void Erase(std::uint64_t simulator, const std::string& hash);

  /// All numbers of the simulator are free again.
  void Release(std::uint64_t simulator);

  std::size_t size() const { return hashes_.size(); }

 private:
  std::map<std::pair<std::uint64_t, std::uint32_t>, std::string> hashes_;
  std::map<std::pair<std::uint64_t, std::string>, std::uint32_t> numbers_;  ///< The inverse.
};

}  // namespace collision::server
