// A secured world of its own for one test: an authority, the service, and two simulators that meet.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "client/programs/tools/certificates/authority.h"
#include "tests/system/test_world.h"

namespace collision::system_test {

/// Seconds since 1970.
std::int64_t SecondsNow();

class SecuredWorld {
 public:
  /// `domain` is the test's own. `more`: as of TestWorld.
  explicit SecuredWorld(int domain, const std::string& clock = "simulators_awaited: 2",
                        client::Period of_service = {0, 0});

  const TestWorld& world() const { return world_; }
  Process& daemon() { return *daemon_; }

  /// The folder of these credentials, made when they are asked for first. They hold for a day.
  std::string CredentialsOf(const std::string& role, const std::string& name);

  /// The same, for `seconds` from now.
  std::string ShortCredentialsOf(const std::string& role, const std::string& name,
                                 std::int64_t seconds);

  std::unique_ptr<Process> StartSimulator(const Flight& flight,
                                          const std::vector<std::string>& options = {});

  /// Runs collisionctl as a monitor with credentials to its end.
  Outcome Monitor(const std::vector<std::string>& words);

  /// Starts a program of the tests with these credentials; world and domain follow its words.
  std::unique_ptr<Process> StartIntruder(const std::vector<std::string>& words,
                                         const std::string& credentials);

  /// Likewise, one whose own DDS lets it do anything (permissive_access_control.c).
  std::unique_ptr<Process> StartBreaker(const std::vector<std::string>& words,
                                        const std::string& credentials);

  /// Both simulators fly to their end, and a monitor sees the contact and nothing else.
  void ExpectHonestFlight();

 private:
  std::unique_ptr<Process> Start(const std::vector<std::string>& words,
                                 const std::vector<std::string>& variables);

  TestWorld world_;
  client::Authority authority_;
  std::unique_ptr<Process> daemon_;
};

/// Replaces each `before` in a file.
void Edit(const std::string& path, const std::string& before, const std::string& after);

}  // namespace collision::system_test
