#include "idl/dds/inbox/inbox.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <type_traits>
#include <utility>

#include "dds/ddsi/ddsi_keyhash.h"
#include "dds/ddsi/ddsi_serdata.h"
#include "idl/dds/inbox/senders.h"
#include "idl/dds/security/domain_facts.h"

namespace collision::dds {
namespace {

/// Of the status that comes with a sample, as RTPS numbers it (PID_STATUS_INFO).
constexpr std::uint32_t kDisposed = 1;

/// It is worth giving back memory after so much has waited, and a quarter of it is left [bytes].
constexpr std::size_t kReliefMin = std::size_t{16} << 20;

/// The locks are held for so many samples at a time, since DDS waits for them meanwhile.
constexpr std::size_t kAtATime = 1024;

std::int64_t Now() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

}  // namespace

void ReleaseSerdata::operator()(ddsi_serdata* data) const { ddsi_serdata_unref(data); }

bool ArrivedSample::has_data() const { return data->kind == SDK_DATA; }

bool ArrivedSample::is_disposed() const { return (data->statusinfo & kDisposed) != 0; }

/// What Cyclone DDS calls: it knows the base, which therefore comes first.
struct Inbox::History {
  dds_rhc base{};
  std::size_t topic = 0;
  std::size_t depth = 0;
  bool keeps_place = false;
  /// Set last: whichever thread of DDS reads it sees all that is above, and the inbox as it was.
  std::atomic<Inbox*> inbox = nullptr;

  template <class Base>
  static History& Of(Base* base) {
    static_assert(std::is_standard_layout_v<History>);
    return *reinterpret_cast<History*>(base);
  }

  /// Never false, by which DDS would try again, and hear nothing else meanwhile.
  static bool Store(ddsi_rhc* rhc, const ddsi_writer_info* writer, ddsi_serdata* data,
                    ddsi_tkmap_instance*) {
    const History& self = Of(rhc);
    // A writer that only withdraws says nothing that a simulator means.
    if (data->kind == SDK_DATA || (data->statusinfo & kDisposed) != 0) {
      self.inbox.load()->Put(self, *writer, data);
    }
    return true;
  }

  static void Unregister(ddsi_rhc* rhc, const ddsi_writer_info* writer) {
    Inbox& inbox = *Of(rhc).inbox.load();
    const std::lock_guard lock(inbox.mutex_);
    inbox.writers_.erase(writer->iid);
  }

  /// In the thread that makes the reader.
  static dds_return_t Associate(dds_rhc* rhc, dds_reader*, const ddsi_sertype* type, ddsi_tkmap*) {
    const char* open_interface = CollisionOpenInterface(type);
    Of(rhc).inbox.load()->domain_ = {open_interface == nullptr ? "" : open_interface,
                                     CollisionProfileSecures(type) != 0};
    return DDS_RETCODE_OK;
  }

  /// The readers end together, and DDS wants all samples back before it ends itself.
  static void Free(ddsi_rhc* rhc) {
    const std::unique_ptr<History> self(&Of(rhc));
    Inbox& inbox = *self->inbox.load();
    const std::lock_guard lock(inbox.mutex_);
    inbox.queues_.Clear();
  }
};

const dds_rhc_ops Inbox::kOperations = {
    .rhc_ops = {.store = &History::Store,
                .unregister_wr = &History::Unregister,
                .relinquish_ownership = [](ddsi_rhc*, std::uint64_t) {},
                .set_qos = [](ddsi_rhc*, const dds_qos*) {},
                .free = &History::Free},
    .read = [](dds_rhc*, bool, void**, dds_sample_info_t*, std::uint32_t, std::uint32_t,
               dds_instance_handle_t, dds_readcond*) -> std::int32_t { return 0; },
    .take = [](dds_rhc*, bool, void**, dds_sample_info_t*, std::uint32_t, std::uint32_t,
               dds_instance_handle_t, dds_readcond*) -> std::int32_t { return 0; },
    .readcdr = [](dds_rhc*, bool, ddsi_serdata**, dds_sample_info_t*, std::uint32_t, std::uint32_t,
                  std::uint32_t, std::uint32_t,
                  dds_instance_handle_t) -> std::int32_t { return 0; },
    .takecdr = [](dds_rhc*, bool, ddsi_serdata**, dds_sample_info_t*, std::uint32_t, std::uint32_t,
                  std::uint32_t, std::uint32_t,
                  dds_instance_handle_t) -> std::int32_t { return 0; },
    .add_readcondition = [](dds_rhc*, dds_readcond*) { return false; },
    .remove_readcondition = [](dds_rhc*, dds_readcond*) {},
    .lock_samples = [](dds_rhc*) -> std::uint32_t { return 0; },
    .associate = &History::Associate};

dds_rhc* Inbox::MakeHistory(std::size_t topic, std::size_t depth, bool keeps_place) {
  auto history = std::make_unique<History>();
  history->base.common.ops = &kOperations;
  history->topic = topic;
  history->depth = depth;
  history->keeps_place = keeps_place;
  history->inbox = this;
  return &history.release()->base;
}

void Inbox::Put(const History& history, const ddsi_writer_info& writer, ddsi_serdata* data) {
  ArrivedSample sample{history.topic, SenderOf(writer.guid), writer.iid, Now(),
                       std::unique_ptr<ddsi_serdata, ReleaseSerdata>(ddsi_serdata_ref(data))};
  SampleFacts facts;
  facts.sender = sample.sender;
  facts.key.writer = writer.iid;
  facts.key.disposal = !sample.has_data();
  // No key is longer, so that this is the key itself and not a hash of it.
  ddsi_keyhash key{};
  static_assert(sizeof key.value == sizeof facts.key.key);
  ddsi_serdata_get_keyhash(data, &key, false);
  std::copy(std::begin(key.value), std::end(key.value), facts.key.key.begin());
  facts.depth = facts.key.disposal ? 1 : history.depth;
  facts.keeps_place = history.keeps_place;
  facts.bytes = ddsi_serdata_size(data);
  dds_entity_t to_trigger = 0;
  {
    const std::lock_guard lock(mutex_);
    const NewWriter known{history.topic, facts.sender, writer.iid};
    if (writers_.try_emplace(writer.iid, known).second) new_writers_.push_back(known);
    using enum SenderQueues<ArrivedSample>::Outcome;
    const std::int64_t now_ns = Now();
    const auto outcome = queues_.Put(facts, std::move(sample), now_ns);
    if (outcome == kIgnoredFromNow) {
      ignored_.push_back({known, queues_.IgnoredFor(facts.sender, now_ns)});
    }
    waiting_most_ = std::max(waiting_most_, queues_.waiting_bytes());
    if (!triggered_ && (outcome == kWaits || outcome == kIgnoredFromNow)) {
      triggered_ = true;
      to_trigger = guard_;
    }
  }
  if (to_trigger != 0) dds_set_guardcondition(to_trigger, true);
}

std::vector<ArrivedSample> Inbox::Take(std::size_t samples, std::size_t bytes) {
  std::vector<ArrivedSample> taken;
  std::size_t size = 0, before = 0;
  do {
    before = taken.size();
    const std::lock_guard lock(mutex_);
    triggered_ = false;
    if (before == 0) bytes = std::min(bytes, queues_.AtOnce());
    queues_.Take(std::min(samples - before, kAtATime), bytes - size, Now(), &taken);
    for (std::size_t i = before; i < taken.size(); ++i) {
      size += std::min(bytes - size, ddsi_serdata_size(taken[i].data.get()) + kSampleOverhead);
    }
  } while (taken.size() > before && taken.size() < samples && size < bytes);
  const std::int64_t now_ns = Now();
  std::int64_t oldest_ns = now_ns;
  for (const ArrivedSample& sample : taken) oldest_ns = std::min(oldest_ns, sample.arrived_ns);
  waited_ns_ = now_ns - oldest_ns;
  return taken;
}

std::vector<NewWriter> Inbox::TakeNewWriters() {
  const std::lock_guard lock(mutex_);
  return std::exchange(new_writers_, {});
}

std::vector<IgnoredSender> Inbox::TakeIgnoredSenders() {
  const std::lock_guard lock(mutex_);
  return std::exchange(ignored_, {});
}

std::vector<InboxLoss> Inbox::Losses() const {
  const std::lock_guard lock(mutex_);
  std::vector<InboxLoss> losses;
  for (const SenderLoss& loss : queues_.Losses(Now())) {
    const auto writer = std::find_if(writers_.begin(), writers_.end(), [&](const auto& known) {
      return known.second.sender == loss.sender;
    });
    losses.push_back({{}, loss});
    if (writer != writers_.end()) losses.back().writer = writer->second;
  }
  return losses;
}

std::optional<std::int64_t> Inbox::UntilReady() {
  const std::lock_guard lock(mutex_);
  return queues_.UntilReady(Now());
}

bool Inbox::TakeRelief() {
  const std::lock_guard lock(mutex_);
  if (waiting_most_ < kReliefMin || queues_.waiting_bytes() > waiting_most_ / 4) return false;
  waiting_most_ = queues_.waiting_bytes();
  return true;
}

std::uint64_t Inbox::refused() const {
  const std::lock_guard lock(mutex_);
  return queues_.refused();
}

}  // namespace collision::dds
