#include "client/programs/tools/collisionctl/operator_request.h"

#include <chrono>
#include <cstdio>
#include <iostream>
#include <random>

#include "client/library/network/dds_transport.h"
#include "client/programs/shared/exit_code.h"

namespace collision::client {
namespace {

constexpr char kDone[] = "done: ";

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
  char key[32];
  std::snprintf(key, sizeof key, "operator.%016llx",
                static_cast<unsigned long long>(command.command_id()));
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

int RunOperatorRequest(const std::string& world, std::uint32_t domain, double timeout_s,
                       const v1::OperatorCommand& command) {
  const auto transport = ConnectOperator(world, domain);
  const std::chrono::duration<double> timeout(timeout_s);
  const Deadline deadline(std::chrono::duration_cast<std::chrono::nanoseconds>(timeout));
  const RequestResult result = Request(transport.get(), command, deadline);
  switch (result.outcome) {
    case RequestOutcome::kDone:
      std::cout << result.answer << std::endl;
      return kExitOk;
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
  std::cerr << "collisionctl: no service in world \"" << world << "\" on domain " << domain
            << " within " << timeout_s << " s\n";
  return kExitUnavailable;
}

}  // namespace collision::client
