#include "server/intake/partner_names.h"

#include <algorithm>
#include <deque>
#include <limits>

#include "idl/identity.h"

namespace collision::server {

class PartnerNames::Table {
 public:
  struct Entry {
    std::uint32_t number = 0;
    std::uint32_t uses = 0;
    std::uint64_t given_up = 0;  ///< Which of all that were given up it was last.
  };
  using Place = std::map<Key, Entry>::iterator;

  Place Take(const Key& key) {
    const auto [place, is_new] = names_.try_emplace(key);
    if (is_new && last_ < std::numeric_limits<std::uint32_t>::max()) place->second.number = ++last_;
    ++place->second.uses;
    return place;
  }

  void Release(Place place) {
    if (--place->second.uses > 0) return;
    place->second.given_up = ++given_up_;
    unused_.push_back({place, given_up_});
    if (unused_.size() <= kUnusedMax) return;
    const auto [oldest, when] = unused_.front();
    unused_.pop_front();
    // One that was used again since was given up later, or is in use.
    if (oldest->second.uses == 0 && oldest->second.given_up == when) names_.erase(oldest);
  }

  std::size_t size() const { return names_.size(); }

 private:
  std::map<Key, Entry> names_;
  std::deque<std::pair<Place, std::uint64_t>> unused_;  ///< In the order of giving up.
  std::uint64_t given_up_ = 0;
  std::uint32_t last_ = 0;
};

/// The names of one description.
class PartnerNames::Use {
 public:
  explicit Use(std::shared_ptr<Table> table) : table_(std::move(table)) {}
  Use(const Use&) = delete;
  Use& operator=(const Use&) = delete;
  ~Use() {
    for (const Table::Place& place : places_) table_->Release(place);
  }

  std::uint32_t NumberOf(const Key& key) {
    places_.push_back(table_->Take(key));
    return places_.back()->second.number;
  }

  void AddTo(std::vector<std::uint32_t>* numbers, const Key& key) {
    if (const std::uint32_t number = NumberOf(key); number != 0) numbers->push_back(number);
  }

 private:
  std::shared_ptr<Table> table_;
  std::vector<Table::Place> places_;
};

namespace {

void MakeUnique(std::vector<std::uint32_t>* numbers) {
  std::sort(numbers->begin(), numbers->end());
  numbers->erase(std::unique(numbers->begin(), numbers->end()), numbers->end());
}

}  // namespace

PartnerNames::PartnerNames(const v1::Config& config) : table_(std::make_shared<Table>()) {
  const auto key = [](const std::string& name) {
    const std::size_t slash = name.find('/');
    return Key(SimulatorId(name.substr(0, slash)), name.substr(slash + 1));
  };
  for (const v1::ExcludedPair& pair : config.excluded()) {
    excluded_[key(pair.first())].push_back(key(pair.second()));
  }
}

std::shared_ptr<const void> PartnerNames::Complete(const v1::AgentDescription& wire,
                                                   broad_phase::CollisionFilter* filter) {
  const std::uint64_t simulator = wire.simulator_id();
  auto use = std::make_shared<Use>(table_);
  filter->assembly = wire.assembly().empty() ? 0 : use->NumberOf({simulator, wire.assembly()});
  filter->name = use->NumberOf({simulator, wire.agent_name()});
  broad_phase::PartnerLists lists;
  for (const std::string& name : wire.meets_in_assembly()) {
    use->AddTo(&lists.meets_in_assembly, {simulator, name});
  }
  for (const std::string& name : wire.never_meets()) {
    use->AddTo(&lists.never_meets, {simulator, name});
  }
  if (const auto found = excluded_.find({simulator, wire.agent_name()}); found != excluded_.end()) {
    for (const Key& partner : found->second) use->AddTo(&lists.never_meets, partner);
  }
  MakeUnique(&lists.meets_in_assembly);
  MakeUnique(&lists.never_meets);
  const bool none = lists.meets_in_assembly.empty() && lists.never_meets.empty();
  filter->partners =
      none ? nullptr : std::make_shared<const broad_phase::PartnerLists>(std::move(lists));
  return use;
}

std::size_t PartnerNames::size() const { return table_->size(); }

}  // namespace collision::server
