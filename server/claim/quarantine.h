// Which message was being applied when the service last failed.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "idl/messages.pb.h"
#include "server/claim/journalled_simulator.h"

namespace collision::server {

/// A message as it comes back after a restart: whose it is, of which kind and place (slot or
/// chunk), and what it says.
struct MessageMark {
  std::uint64_t simulator = 0;
  std::uint64_t content = 0;
  std::uint32_t kind = 0;  ///< v1::Input::MessageCase; 0: of no kind that comes back.
  std::uint32_t place = 0;

  friend bool operator==(const MessageMark&, const MessageMark&) = default;
};

/// The mark of a description, a part of a shape, states or a clock; of others one of kind 0. Equal
/// for a message that is written again with the same content, and for all parts of a shape.
MessageMark MarkOf(const v1::Input& input);

/// Breaks the circle of a message that fails the service, comes back out of the network's history
/// when it is started again, and fails it again.
///
/// A small file beside the journal, mapped into memory, holds the marks of the messages of the step
/// that runs, and which of them is being applied. It costs a few stores for each message, and
/// outlives the process however that ends (an exception, a signal, the kernel's OOM killer), not
/// the machine.
///
/// A start that finds a step unfinished *suspects* the message that was being applied or, if all
/// were, every message of that step. A suspected message is applied in a step of its own, before
/// all that comes with it. If it fails the service again, it is *quarantined*: refused as long as
/// it comes with the same content. If it does not, or has been replaced, it is no longer
/// suspected; a shape is until the service ends as asked.
///
/// Both lists are bounded; beyond, the oldest are forgotten. To forget all, remove the file while
/// the service is stopped. A failure that comes in a later step than the message that caused it, or
/// on a thread that builds shapes, is not attributed. One thread.
class Quarantine {
 public:
  /// Marks of one step that are kept, the last ones; also the most that are suspected.
  static constexpr std::uint32_t kMarksMax = 4096;
  static constexpr std::uint32_t kQuarantinedMax = 256;

  /// Simulators whose names are known; beyond, others are told by their id.
  static constexpr std::size_t kNamesMax = 4096;

  using Roster = std::map<std::uint64_t, JournalledSimulator>;

  /// Opens the file of a world in `folder`, which exists, or makes it. What is damaged is begun
  /// anew. `roster`: names of simulators, for log and status; those of others are known once they
  /// come back. Throws std::runtime_error with path and cause.
  Quarantine(const std::string& folder, const std::string& world, std::uint32_t domain,
             const Roster& roster = {});
  /// An end between two steps also ends all suspicion.
  ~Quarantine();
  Quarantine(const Quarantine&) = delete;
  Quarantine& operator=(const Quarantine&) = delete;

  const std::string& path() const { return path_; }

  /// Marks what is suspected and quarantined, and leaves in the batch what this step applies: one
  /// suspected message, or all others. What it takes out comes with the next steps.
  void Screen(std::vector<v1::Input>* batch);

  /// Whether messages wait, so that the next step need not receive any.
  bool holds() const { return !suspected_waiting_.empty() || !waiting_.empty(); }

  /// A step begins; the next message of it is applied; all are applied; it is over.
  void BeginStep();
  void Apply(const v1::Input& input);
  void EndMessages();
  void EndStep();

  /// The program ends in the middle of a step because it was asked to. Any thread.
  void AbandonStep();

  std::uint32_t suspected() const;
  std::uint32_t quarantined() const;

  /// A line for the status, empty if nothing is suspected or quarantined.
  std::string Summary() const;

 private:
  struct Page;

  void Begin();
  void TakeUnfinishedStep();
  void LogSuspicion() const;
  std::string TextOf(const MessageMark& mark) const;
  void KeepName(std::uint64_t simulator, const std::string& name);
  void Suspect(const MessageMark& mark, bool convicts);
  bool IsSuspected(const MessageMark& mark) const;
  bool IsQuarantined(const MessageMark& mark) const;
  void Acquit(const MessageMark& mark);
  void AcquitReplaced(const MessageMark& newer);

  const std::string path_;
  std::map<std::uint64_t, std::string> names_;  ///< At most kNamesMax; others are told by their id.
  Page* page_ = nullptr;
  std::vector<v1::Input> waiting_;
  std::deque<v1::Input> suspected_waiting_;
  std::optional<MessageMark> on_trial_;  ///< The suspected message of this step.
};

}  // namespace collision::server
