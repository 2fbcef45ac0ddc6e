// What an operator asks of a service, and its answer.
#pragma once

#include <optional>
#include <string>

#include "client/library/deadline.h"
#include "client/library/network/dds_transport.h"
#include "client/library/network/transport.h"
#include "idl/messages.pb.h"

namespace collision::client {

enum class RequestOutcome {
  kDone,
  kRefused,    ///< The answer says why.
  kNoService,  ///< None serves this world.
  kNoAnswer    ///< One serves it, and has not answered in time: it may still obey.
};

struct RequestResult {
  RequestOutcome outcome = RequestOutcome::kNoService;
  std::string answer;  ///< As the service gave it, with "done: " or "refused: "; else empty.
};

/// A command with a random id.
v1::OperatorCommand MakeCommand(v1::OperatorCommandKind kind, const std::string& simulator);

/// Waits for a service that serves, hands it the command and waits for its answer.
RequestResult Request(Transport* transport, const v1::OperatorCommand& command,
                      const Deadline& deadline);

/// The answer to this command in a status; nullopt: it has none.
std::optional<std::string> AnswerIn(const v1::ServiceStatus& status,
                                    const v1::OperatorCommand& command);

/// A document of kind "answer": whether the service obeyed, and its words, without "done: " or
/// "refused: "; null: it has not answered. One line without a newline.
std::string ResultJson(const RequestResult& result);

/// Connects, requests, and prints the answer: to standard output, or the reason of a failure to
/// standard error. With `json` the result of a request that was made goes to standard output, too,
/// whatever it is. Returns the exit code. Throws std::runtime_error if DDS is not available.
int RunOperatorRequest(const Place& place, double timeout_s, const v1::OperatorCommand& command,
                       bool json);

}  // namespace collision::client
