#include "client/programs/tools/collisionctl/operator_request.h"

#include <chrono>
#include <iostream>
#include <random>

#include "client/programs/shared/exit_code.h"
#include "client/programs/tools/collisionctl/json/json_writer.h"
#include "idl/identity.h"

namespace collision::client {
namespace {

constexpr char kDone[] = "done: ";
constexpr char kRefused[] = "refused: ";

}  // namespace

v1::OperatorCommand MakeCommand(v1::OperatorCommandKind kind, const std::string& simulator) {
  std::random_device source;
  const std::uint64_t high = source();
  v1::OperatorCommand command;
  command.set_command_id(high << 32 | source());
  command.set_kind(kind);
  command.set_simulator(simulator);
  return command;
}

std::optional<std::string> AnswerIn(const v1::ServiceStatus& status,
                                    const v1::OperatorCommand& command) {
  const std::string key = "operator." + IdText(command.command_id());
  for (const v1::KeyValue& extension : status.extensions()) {
    if (extension.key() == key) return extension.value();
  }
  return std::nullopt;
}

RequestResult Request(Transport* transport, const v1::OperatorCommand& command,
                      const Deadline& deadline) {
  RequestResult result;
  bool written = false;
  do {
    Arrivals arrivals;
    transport->Receive(deadline.Remaining(), &arrivals);
    for (const v1::Output& output : arrivals.outputs) {
      if (!output.has_service_status()) continue;
      const v1::ServiceStatus& status = output.service_status();
      if (status.phase() != v1::PHASE_SERVING) continue;
      if (!written) {
        v1::Input message;
        *message.mutable_operator_command() = command;
        transport->Write(message);
        transport->Flush();
        written = true;
        result.outcome = RequestOutcome::kNoAnswer;
      } else if (const auto answer = AnswerIn(status, command)) {
        const bool done = answer->rfind(kDone, 0) == 0;
        return {done ? RequestOutcome::kDone : RequestOutcome::kRefused, *answer};
      }
    }
  } while (deadline.Remaining().count() > 0);
  return result;
}

std::string ResultJson(const RequestResult& result) {
  const bool done = result.outcome == RequestOutcome::kDone;
  const std::string& answer = result.answer;
  const std::string prefix = done ? kDone : kRefused;
  const std::string text = answer.starts_with(prefix) ? answer.substr(prefix.size()) : answer;
  return JsonDocument("answer").Flag("done", done).TextOrNull("answer", text).Json();
}

int RunOperatorRequest(const Place& place, double timeout_s, const v1::OperatorCommand& command,
                       bool json) {
  const auto transport = ConnectOperator(place);
  const std::chrono::duration<double> timeout(timeout_s);
  const Deadline deadline(std::chrono::duration_cast<std::chrono::nanoseconds>(timeout));
  const RequestResult result = Request(transport.get(), command, deadline);
  if (json && result.outcome != RequestOutcome::kNoService) {
    std::cout << ResultJson(result) << std::endl;
  }
  switch (result.outcome) {
    case RequestOutcome::kDone:
      if (!json) std::cout << result.answer << std::endl;
      if (std::cout) return kExitOk;
      std::cerr << "collisionctl: the output cannot be written\n";
      return kExitOutputFailed;
    case RequestOutcome::kRefused:
      std::cerr << "collisionctl: " << result.answer << '\n';
      return kExitRefused;
    case RequestOutcome::kNoAnswer:
      std::cerr << "collisionctl: the service has not answered within " << timeout_s
                << " s; it may still obey: collisionctl status shows it\n";
      return kExitRefused;
    case RequestOutcome::kNoService:
      break;
  }
  std::cerr << "collisionctl: no service in world \"" << place.world << "\" on domain "
            << place.domain << " within " << timeout_s << " s\n";
  return kExitUnavailable;
}

}  // namespace collision::client
