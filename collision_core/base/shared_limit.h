// One limit, shared out among those that use it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>

namespace collision {

/// A user's part of a limit.
struct Share {
  std::uint64_t max = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t guaranteed = 0;  ///< Kept free for it while it is present.
};

/// Keeps one greedy user from taking what the others need. The rule: a user may have what is free,
/// less what the others that are present have not used of what they are guaranteed. So a user that
/// is alone may have everything. Nothing that was taken is taken back. Single-threaded.
template <typename Key>
class SharedLimit {
 public:
  /// What one user has. Its address stays while the user is present or uses anything.
  struct Account {
    Key key{};
    Share share{};
    std::uint32_t present = 0;  ///< How often it has entered and not left.
    std::uint64_t used = 0;

    /// What is kept free for it.
    std::uint64_t kept() const {
      return present == 0 ? 0 : share.guaranteed - std::min(share.guaranteed, used);
    }
  };

  Account* Enter(const Key& key) {
    Account* account = At(key);
    Change(account, [](Account* changed) { ++changed->present; });
    return account;
  }

  /// The user's account, present or not.
  Account* At(const Key& key) {
    return &accounts_.try_emplace(key, Account{.key = key}).first->second;
  }

  /// Requires Enter().
  void Leave(Account* account) {
    Change(account, [](Account* changed) { --changed->present; });
    EraseIfIdle(account);
  }

  void SetShare(Account* account, const Share& share) {
    Change(account, [&share](Account* changed) { changed->share = share; });
  }

  void Take(Account* account, std::uint64_t amount) {
    Change(account, [amount](Account* changed) { changed->used += amount; });
  }

  void GiveBack(Account* account, std::uint64_t amount) {
    Change(account, [amount](Account* changed) { changed->used -= amount; });
    EraseIfIdle(account);
  }

  /// How much of what is `free` in all the user may have. O(1).
  std::uint64_t RoomFor(const Account& account, std::uint64_t free) const {
    const std::uint64_t kept = kept_ - account.kept();
    const std::uint64_t own = account.share.max - std::min(account.share.max, account.used);
    return std::min(own, free - std::min(free, kept));
  }

  /// Null: it is neither present nor uses anything.
  Account* Find(const Key& key) {
    const auto found = accounts_.find(key);
    return found == accounts_.end() ? nullptr : &found->second;
  }
  const Account* Find(const Key& key) const {
    const auto found = accounts_.find(key);
    return found == accounts_.end() ? nullptr : &found->second;
  }

 private:
  template <typename Changing>
  void Change(Account* account, const Changing& change) {
    kept_ -= account->kept();
    change(account);
    kept_ += account->kept();
  }

  void EraseIfIdle(const Account* account) {
    if (account->present == 0 && account->used == 0) accounts_.erase(Key(account->key));
  }

  std::map<Key, Account> accounts_;
  std::uint64_t kept_ = 0;  ///< For all that are present.
};

}  // namespace collision
