#include "tests/system/secured_world.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "idl/credentials/files.h"

namespace collision::system_test {
namespace {

constexpr std::int64_t kDay = 86400;

DdsRole RoleOf(const std::string& role) {
  if (role == "service") return DdsRole::kService;
  if (role == "simulator") return DdsRole::kSimulator;
  return role == "operator" ? DdsRole::kOperator : DdsRole::kMonitor;
}

std::string Variable(const std::string& folder) {
  return std::string(credentials::kVariable) + "=" + folder;
}

}  // namespace

std::int64_t SecondsNow() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::seconds>(now).count();
}

SecuredWorld::SecuredWorld(int domain, const std::string& clock, client::Period of_service)
    : world_(domain, clock),
      authority_(client::Authority::Make(world_.folder().Path("lab"),
                                         {world_.name(), world_.domain()}, SecondsNow())) {
  const client::Bearer bearer{DdsRole::kService, "service"};
  const client::Period day{SecondsNow() - kDay, SecondsNow() + kDay};
  const std::string folder = authority_.Issue(bearer, of_service.end > 0 ? of_service : day);
  daemon_ = world_.StartDaemon({"--credentials", folder});
}

std::string SecuredWorld::CredentialsOf(const std::string& role, const std::string& name) {
  return ShortCredentialsOf(role, name, kDay);
}

std::string SecuredWorld::ShortCredentialsOf(const std::string& role, const std::string& name,
                                             std::int64_t seconds) {
  const client::Bearer bearer{RoleOf(role), name};
  if (std::filesystem::exists(authority_.FolderOf(bearer))) return authority_.FolderOf(bearer);
  return authority_.Issue(bearer, {SecondsNow() - kDay, SecondsNow() + seconds});
}

std::unique_ptr<Process> SecuredWorld::StartSimulator(const Flight& flight,
                                                      const std::vector<std::string>& options) {
  std::vector<std::string> words = {"--credentials",
                                    CredentialsOf("simulator", flight.name + "-sim")};
  words.insert(words.end(), options.begin(), options.end());
  return world_.StartSimulator(flight, words);
}

Outcome SecuredWorld::Monitor(const std::vector<std::string>& words) {
  std::vector<std::string> with = {"--credentials", CredentialsOf("monitor", "desk")};
  with.insert(with.end(), words.begin(), words.end());
  return world_.Monitor(with);
}

std::unique_ptr<Process> SecuredWorld::Start(const std::vector<std::string>& words,
                                             const std::vector<std::string>& variables) {
  std::vector<std::string> command = words, all = variables;
  command[0] = Program(words[0]);
  if (words[0] != "star-writer") command.push_back(world_.name());
  command.push_back(std::to_string(world_.domain()));
  all.push_back("CYCLONEDDS_URI=file://" + ConfigFile("cyclonedds-loopback.xml"));
  return std::make_unique<Process>(command, all);
}

std::unique_ptr<Process> SecuredWorld::StartIntruder(const std::vector<std::string>& words,
                                                     const std::string& credentials) {
  return Start(words, {Variable(credentials)});
}

std::unique_ptr<Process> SecuredWorld::StartBreaker(const std::vector<std::string>& words,
                                                    const std::string& credentials) {
  return Start(words, {Variable(credentials),
                       std::string("LD_LIBRARY_PATH=") + COLLISION_BIN_DIR + "/permissive"});
}

void SecuredWorld::ExpectHonestFlight() {
  const auto left = StartSimulator(kLeft), right = StartSimulator(kRight);
  EXPECT_EQ(left->WaitForExit(), 0) << left->err() << daemon_->err();
  EXPECT_EQ(right->WaitForExit(), 0) << right->err() << daemon_->err();
  const Outcome events = Monitor({"events"});
  EXPECT_TRUE(Contains(events.out, "ended      left × right")) << events.out << events.err;
  EXPECT_FALSE(Contains(events.out, "forged")) << events.out;
  daemon_->WaitForOutput("\n", std::chrono::nanoseconds(1));  // what it has written meanwhile
}

void Edit(const std::string& path, const std::string& before, const std::string& after) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  std::size_t edits = 0;
  for (std::size_t at = text.find(before); at != std::string::npos; at = text.find(before, at)) {
    text.replace(at, before.size(), after);
    at += after.size();
    ++edits;
  }
  if (edits == 0) throw std::logic_error(path + " does not say " + before);
  std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
}

}  // namespace collision::system_test
