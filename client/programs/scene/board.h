// What viewers are shown: the newest of each item, and which of them are new to whom.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "client/programs/scene/payload.h"

namespace collision::client {

/// Items by name, each with its newest payload, in the order in which they changed. A viewer knows
/// up to which change it has everything, and takes what changed since: of an item that changed
/// often meanwhile the newest alone. Any thread.
class Board {
 public:
  struct Item {
    std::string name;
    Payload payload;
  };

  /// What one viewer has not seen yet.
  struct News {
    std::vector<Item> items;
    std::uint64_t seen = 0;  ///< For the next call.
  };

  void Put(const std::string& name, Payload payload);

  /// The oldest changes after `seen`, at most about `bytes_max` of them, and at least one if there
  /// is one; nothing of an item that is gone.
  News After(std::uint64_t seen, std::size_t bytes_max) const;

  /// It is shown no more; viewers are not told: an item that says so takes its place before.
  void Remove(const std::string& name);

  /// Removes all items.
  void Clear();

  std::size_t size() const;

 private:
  struct Entry {
    std::string name;
    Payload payload;
  };

  mutable std::mutex mutex_;
  std::map<std::uint64_t, Entry> changes_;        ///< By number, the newest of each item.
  std::map<std::string, std::uint64_t> numbers_;  ///< Of these, by name.
  std::uint64_t last_ = 0;
};

}  // namespace collision::client
