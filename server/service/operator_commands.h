// What an operator asks of the service.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "idl/messages.pb.h"
#include "server/intake/intake.h"
#include "server/world/world.h"

namespace collision::server {

/// Obeys the commands of operators, or refuses them with a reason, and keeps the answers for the
/// status, where the program that asked finds its own. A command is an input like any other: it is
/// recorded, and a replay obeys it in the same step. One thread.
class OperatorCommands {
 public:
  /// Both outlive this.
  OperatorCommands(World* world, Intake* intake) : world_(*world), intake_(*intake) {}

  /// Obeys one command; one that was answered already (kAnswersKept) is ignored. True: the world's
  /// time is to begin anew, and every run that was in it has been ended.
  bool Obey(const v1::OperatorCommand& command);

  /// The same for all commands of a batch.
  bool ObeyAll(const google::protobuf::RepeatedPtrField<v1::Input>& inputs) {
    bool restarts = false;
    for (const v1::Input& input : inputs) {
      if (input.has_operator_command()) restarts |= Obey(input.operator_command());
    }
    return restarts;
  }

  /// Whether an answer was given since the last call.
  bool TakeNews();

  /// For the status: "operator.ID" -> "done: ..." or "refused: ...", ID as 16 hexadecimal digits.
  void AddExtensions(std::vector<v1::KeyValue>* extensions) const;

 private:
  struct Answer {
    std::uint64_t command_id = 0;
    std::string text;
  };

  std::string Evict(const std::string& name);
  std::string RestartTime();
  std::string KnownNames() const;

  World& world_;
  Intake& intake_;
  std::deque<Answer> answers_;  ///< Newest last.
  bool news_ = false;
};

/// Answers that the status shows; older ones are forgotten.
inline constexpr std::size_t kAnswersKept = 8;

}  // namespace collision::server
