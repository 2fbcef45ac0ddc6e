#include "collision_core/detection/pairs/owner_queues.h"

#include <algorithm>
#include <queue>
#include <tuple>

#include "collision_core/numeric/seconds.h"

namespace collision::detection {
namespace {

/// An owner that may take a turn: the one with the least work in this step is next, of equal ones
/// the first.
struct Candidate {
  std::uint64_t units;
  std::size_t order;

  friend auto operator<=>(const Candidate&, const Candidate&) = default;
};

}  // namespace

void OwnerQueues::AddPair(PairSlot slot, const OwnerId& a, const OwnerId& b) {
  if (!entries_.contains(slot)) entries_.resize(slot.value() + 1);
  CORE_CHECK(entries_[slot].b == nullptr, "a slot has one pair", slot.value());
  const auto join = [this](const OwnerId& id) {
    Queue& owner = owners_[id];
    if (owner.pairs++ == 0) {
      owner.work.owner = id;
      owner.account = &accounts_[id.simulator];
      ++owner.account->owners;
    }
    return &owner;
  };
  Queue* const first = join(a);
  entries_[slot] = Entry{.a = first, .b = a == b ? first : join(b)};
}

void OwnerQueues::RemovePair(PairSlot slot) {
  Entry& entry = entries_.at(slot);
  CORE_CHECK(entry.b != nullptr, "a pair that is tracked has owners", slot.value());
  if (entry.waits_in != nullptr) Unlink(slot);
  if (entry.a != entry.b) Leave(entry.a);
  Leave(entry.b);
  entry = Entry();
}

void OwnerQueues::Leave(Queue* owner) {
  if (--owner->pairs > 0) return;
  if (--owner->account->owners == 0) debtors_.push_back(owner->work.owner.simulator);
  owners_.erase(OwnerId(owner->work.owner));
}

OwnerQueues::Queue* OwnerQueues::PayerOf(const Entry& entry) const {
  if (entry.a->pairs != entry.b->pairs) return entry.a->pairs > entry.b->pairs ? entry.a : entry.b;
  return entry.a->work.owner < entry.b->work.owner ? entry.a : entry.b;
}

OwnerId OwnerQueues::PayerOf(PairSlot slot) const { return PayerOf(entries_.at(slot))->work.owner; }

bool OwnerQueues::IsWaiting(PairSlot slot) const {
  return entries_.contains(slot) && entries_[slot].waits_in != nullptr;
}

bool OwnerQueues::Wait(PairSlot slot) {
  Entry& entry = entries_.at(slot);
  if (entry.waits_in != nullptr) return false;
  Queue* const payer = PayerOf(entry);
  entry.waits_in = payer;
  entry.previous = payer->last;
  entry.next = PairSlot::None();
  (payer->last.is_none() ? payer->first : entries_[payer->last].next) = slot;
  payer->last = slot;
  if (payer->work.waiting++ == 0) waiting_owners_[payer->work.owner] = payer;
  ++payer->work.wanted;
  ++waiting_;
  return true;
}

void OwnerQueues::Unlink(PairSlot slot) {
  Entry& entry = entries_[slot];
  Queue* const payer = entry.waits_in;
  (entry.previous.is_none() ? payer->first : entries_[entry.previous].next) = entry.next;
  (entry.next.is_none() ? payer->last : entries_[entry.next].previous) = entry.previous;
  entry.waits_in = nullptr;
  if (--payer->work.waiting == 0) {
    waiting_owners_.erase(payer->work.owner);
    payer->work.held_since = Instant::Never();
  }
  --waiting_;
}

// A debt is at most one step's work, so that it is paid off within that many resolutions.
void OwnerQueues::GrowCredit(double units, double owners, double most, Instant now,
                             Account* account) const {
  if (account->credited_at == Instant::Always()) {
    account->credit = most;
  } else {
    const double seconds = numeric::SecondsBetween(account->credited_at, now).lower;
    const double more = units / owners * seconds / temporal_resolution_;
    account->credit = std::min(most, std::max(-units, account->credit) + more);
  }
  account->credited_at = now;
}

double OwnerQueues::CreditMax(const Queue& owner, std::uint64_t units) const {
  const std::uint64_t most = IsHeld(owner) ? std::min(2 * slice_, units) : units;
  return static_cast<double>(most);
}

// Simulators without pairs whose debts are paid off.
void OwnerQueues::ForgetSettled(double units, Instant now) {
  const bool many = debtors_.size() > kDebtorsMax;
  std::size_t surplus = many ? debtors_.size() - kDebtorsMax : 0;
  std::erase_if(debtors_, [&](std::uint64_t simulator) {
    const auto found = accounts_.find(simulator);
    if (found == accounts_.end() || found->second.owners > 0) return true;  // it came back
    if (surplus > 0) {
      --surplus;
    } else {
      GrowCredit(units, 1, units, now, &found->second);
      if (found->second.credit < units) return false;
    }
    accounts_.erase(found);
    return true;
  });
}

bool OwnerQueues::GivesWay(const Queue& owner, std::uint64_t units, Instant now) const {
  if (!IsHeld(owner) || owner.sliced_at == Instant::Always()) return false;
  const double slices = static_cast<double>(units) / static_cast<double>(slice_);
  return numeric::SecondsBetween(owner.sliced_at, now).upper <
         kGivesWay * temporal_resolution_ / slices;
}

std::vector<PairTurn> OwnerQueues::Take(std::uint64_t units,
                                        const std::function<std::uint64_t(PairSlot)>& cost,
                                        Instant now, bool news) {
  ForgetSettled(static_cast<double>(units), now);
  std::vector<Queue*> owners;
  const auto next = waiting_owners_.upper_bound(last_turn_);
  for (auto at = next; at != waiting_owners_.end(); ++at) owners.push_back(at->second);
  for (auto at = waiting_owners_.begin(); at != next; ++at) owners.push_back(at->second);
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> candidates;
  const bool others = news || std::any_of(owners.begin(), owners.end(),
                                          [this](const Queue* owner) { return !IsHeld(*owner); });
  for (std::size_t i = 0; i < owners.size(); ++i) {
    GrowCredit(static_cast<double>(units), static_cast<double>(owners.size()),
               CreditMax(*owners[i], units), now, owners[i]->account);
    const bool passes = others && GivesWay(*owners[i], units, now);
    if (owners[i]->account->credit >= 0 && !passes) candidates.push({0, i});
  }
  const auto sharing = static_cast<std::uint32_t>(owners.size());

  std::vector<PairTurn> turns;
  std::uint64_t left = units;
  while (!candidates.empty()) {
    const auto [taken, order] = candidates.top();
    candidates.pop();
    Queue& owner = *owners[order];
    const PairSlot slot = owner.first;
    const std::uint64_t takes = cost(slot);
    if (!turns.empty() && takes > left) break;
    const bool held = IsHeld(owner);
    // A pair that costs more than a slice has all of it, in a step of its own.
    if (held && taken > 0 && taken + takes > slice_) continue;
    left -= std::min(left, takes);
    const std::uint64_t most = held ? std::min(std::max(slice_, takes), units) : units;
    if (held) owner.sliced_at = now;
    turns.push_back({slot, owner.work.owner, takes, most});
    owner.account->credit -= static_cast<double>(takes);
    last_turn_ = owner.work.owner;
    Unlink(slot);
    const bool has_more = owner.work.waiting > 0 && owner.account->credit >= 0;
    if (has_more && (!held || taken + takes < most)) candidates.push({taken + takes, order});
  }
  for (const auto& [id, owner] : waiting_owners_) {
    owner->work.held_since = std::min(owner->work.held_since, now);
    owner->work.sharing = sharing;
  }
  std::sort(turns.begin(), turns.end());
  return turns;
}

void OwnerQueues::RecordEvaluation(const PairTurn& turn, std::uint64_t units) {
  accounts_.at(turn.payer.simulator).credit += static_cast<double>(turn.cost);
  Charge(turn.payer, units);
}

std::uint64_t OwnerQueues::CreditOf(const OwnerId& payer, std::uint64_t units, Instant now) {
  const Queue& owner = owners_.at(payer);
  GrowCredit(static_cast<double>(units), 1, CreditMax(owner, units), now, owner.account);
  return static_cast<std::uint64_t>(std::max(owner.account->credit, 0.0));
}

void OwnerQueues::Charge(const OwnerId& payer, std::uint64_t units) {
  accounts_.at(payer.simulator).credit -= static_cast<double>(units);
  const auto owner = owners_.find(payer);
  if (owner == owners_.end()) return;  // that was its last pair
  ++owner->second.work.evaluated;
  owner->second.work.work_units += units;
}

std::vector<OwnerWork> OwnerQueues::work() const {
  std::vector<OwnerWork> work;
  for (const auto& [id, owner] : owners_) work.push_back(owner.work);
  return work;
}

void OwnerQueues::Validate() const {
  std::map<const Queue*, std::uint32_t> pairs, waiting;
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    const Entry& entry = entries_[PairSlot(k)];
    if (entry.b == nullptr) continue;
    ++pairs[entry.a];
    if (entry.a != entry.b) ++pairs[entry.b];
    if (entry.waits_in == nullptr) continue;
    CORE_CHECK(entry.waits_in == entry.a || entry.waits_in == entry.b,
               "a pair waits in the queue of one of its owners", k);
    ++waiting[entry.waits_in];
  }
  std::size_t all = 0;
  std::map<const Account*, std::uint32_t> of_account;
  for (const auto& [id, owner] : owners_) ++of_account[owner.account];
  for (const auto& [simulator, account] : accounts_) {
    CORE_CHECK(account.owners == of_account[&account], "the owners of an account are counted",
               account.owners);
  }
  for (const auto& [id, owner] : owners_) {
    CORE_CHECK(owner.pairs > 0 && owner.pairs == pairs[&owner], "an owner's pairs are counted",
               owner.pairs);
    std::uint32_t linked = 0;
    for (PairSlot at = owner.first; !at.is_none(); at = entries_[at].next) ++linked;
    CORE_CHECK(linked == owner.work.waiting && linked == waiting[&owner],
               "an owner's waiting pairs are linked", linked, owner.work.waiting);
    CORE_CHECK((linked > 0) == waiting_owners_.contains(id), "owners that wait are listed", linked);
    all += linked;
  }
  CORE_CHECK(all == waiting_, "waiting pairs are counted", all, waiting_);
}

}  // namespace collision::detection
