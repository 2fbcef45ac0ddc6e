// The program as its users meet it: arguments in; lines and an exit code out.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <vector>

#include "server/config.h"
#include "server/options.h"
#include "server/recording.h"

namespace collision::server {
namespace {

constexpr char kLoopback[] =
    "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface name=\"lo\"/>"
    "</Interfaces><AllowMulticast>false</AllowMulticast></General><Discovery>"
    "<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>32"
    "</MaxAutoParticipantIndex><Peers><Peer Address=\"127.0.0.1\"/></Peers></Discovery></Domain>"
    "</CycloneDDS>";
constexpr char kNoInterface[] =
    "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface name=\"nonesuch0\"/>"
    "</Interfaces></General></Domain></CycloneDDS>";

std::string ReadFile(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// A running collisiond. It is killed with the test, should it still run.
class Program {
 public:
  Program(const std::vector<std::string>& arguments, const std::string& output_file) {
    std::vector<char*> argv = {const_cast<char*>("collisiond")};
    for (const std::string& argument : arguments)
      argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    process_ = fork();
    if (process_ != 0) return;
    const int file = open(output_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    dup2(file, STDOUT_FILENO);
    dup2(file, STDERR_FILENO);
    execv(COLLISIOND, argv.data());
    _exit(127);
  }
  ~Program() {
    if (process_ <= 0) return;
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void Signal(int signal) const { kill(process_, signal); }

  /// Waits for its end; -1: it did not end by itself.
  int ExitCode() {
    int status = 0;
    waitpid(process_, &status, 0);
    process_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t process_ = 0;
};

class ProgramTest : public testing::Test {
 protected:
  ProgramTest() {
    setenv("CYCLONEDDS_URI", kLoopback, 1);
    unsetenv("NOTIFY_SOCKET");
  }
  ~ProgramTest() override {
    for (const std::string& path : {output_, file_, socket_}) std::remove(path.c_str());
  }

  /// Runs to the end; then `text_` is what it said.
  int Run(const std::vector<std::string>& arguments) {
    const int code = Program(arguments, output_).ExitCode();
    text_ = ReadFile(output_);
    return code;
  }

  /// Lines in `text_`.
  long Lines() const { return std::count(text_.begin(), text_.end(), '\n'); }

  /// A recording with `batches` empty batches and the given configuration.
  void WriteRecording(const v1::Config& config, int batches) {
    RecordingWriter writer(file_, config);
    for (int i = 0; i < batches; ++i) EXPECT_TRUE(writer.Record({}));
  }

  const std::string stem_ = testing::TempDir() + "program_test." + std::to_string(getpid());
  const std::string output_ = stem_ + ".out", file_ = stem_ + ".file", socket_ = stem_ + ".socket";
  std::string text_;
};

// Goal:   a configuration is checked, and printed as it is in effect, without a network.
TEST_F(ProgramTest, ChecksAndPrintsTheConfiguration) {
  setenv("CYCLONEDDS_URI", kNoInterface, 1);
  EXPECT_EQ(Run({"--print-config", "--domain", "7"}), kExitOk);
  std::ofstream(file_) << text_;
  EXPECT_EQ(LoadConfig(file_).config.domain(), 7u);
  EXPECT_EQ(Run({"--config", file_, "--check-config"}), kExitOk);
  EXPECT_EQ(text_, file_ + ": ok\n");
  std::ofstream(file_) << "domain: 231\nworld: \"\"\n";
  for (const auto* command : {"--check-config", "--print-config", "--log-level=info"}) {
    EXPECT_EQ(Run({"--config", file_, command}), kExitConfiguration);
    EXPECT_EQ(Lines(), 2) << text_;
    EXPECT_TRUE(text_.starts_with(file_ + ":1: domain: 231 is not allowed; allowed: 0 to 230\n"));
  }
  EXPECT_EQ(Run({"--config", file_ + ".missing"}), kExitConfiguration);
  EXPECT_EQ(Run({"--frobnicate"}), kExitUsage);
}

// Goal:   what cannot be had ends the program at once with its code, and a line that says what.
TEST_F(ProgramTest, SaysWhatIsNotToBeHad) {
  EXPECT_EQ(Run({"--record", "/dev/full"}), kExitRecording);
  EXPECT_EQ(text_, "collisiond: /dev/full: byte 0: cannot be written: No space left on device\n");
  std::ofstream(file_) << "log_file: \"/dev/null/log\"";
  EXPECT_EQ(Run({"--config", file_}), kExitConfiguration);
  EXPECT_TRUE(text_.starts_with("collisiond: log_file: ")) << text_;
  setenv("CYCLONEDDS_URI", kNoInterface, 1);
  EXPECT_EQ(Run({}), kExitUnavailable);
  EXPECT_NE(text_.find("collisiond: "), std::string::npos);
}

// Goal:   a recording is replayed without a network; one that ends too early, or is none, is one
// line and 74.
TEST_F(ProgramTest, Replays) {
  setenv("CYCLONEDDS_URI", kNoInterface, 1);
  WriteRecording(CompleteConfig({}), 3);
  EXPECT_EQ(Run({"--replay", file_, "--log-level", "error"}), kExitOk);
  EXPECT_NE(text_.find("event log: 0 events, hash cbf29ce484222325\n"), std::string::npos) << text_;
  const std::string whole = ReadFile(file_);
  std::ofstream(file_) << whole.substr(0, whole.size() - 1);
  EXPECT_EQ(Run({"--replay", file_, "--log-level", "error"}), kExitRecording);
  EXPECT_EQ(Lines(), 2) << text_;
  EXPECT_NE(text_.find("event log: 0 events"), std::string::npos);
  EXPECT_NE(text_.find(": cut off\n"), std::string::npos) << text_;
  WriteRecording({}, 1);
  EXPECT_EQ(Run({"--replay", file_}), kExitRecording);
  EXPECT_NE(text_.find(": byte 0: its configuration: "), std::string::npos) << text_;
  EXPECT_EQ(Run({"--replay", file_ + ".missing"}), kExitRecording);
  EXPECT_EQ(Lines(), 1) << text_;
}

// Goal:   the service tells its manager when it is ready and when it stops; SIGTERM and SIGINT
//         end it with 0, the last line is its event log, and the recording is complete and
//         replays to the same.
TEST_F(ProgramTest, ServesUntilASignal) {
  for (const int signal : {SIGTERM, SIGINT}) {
    const int manager = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, socket_.c_str(), sizeof address.sun_path - 1);
    std::remove(socket_.c_str());
    ASSERT_EQ(bind(manager, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    setenv("NOTIFY_SOCKET", socket_.c_str(), 1);
    Program program({"--domain", "119", "--record", file_, "--log-level", "off"}, output_);
    const auto said = [manager] {
      pollfd waiting{manager, POLLIN, 0};
      char message[64] = "";
      constexpr int kPatienceMs = 30'000;
      if (poll(&waiting, 1, kPatienceMs) == 1) recv(manager, message, sizeof message - 1, 0);
      return std::string(message);
    };
    EXPECT_EQ(said(), "READY=1");
    program.Signal(signal);
    EXPECT_EQ(program.ExitCode(), kExitOk);
    EXPECT_EQ(said(), "STOPPING=1");
    close(manager);
    const std::string text = ReadFile(output_);
    const std::string log = "event log: 0 events, hash cbf29ce484222325\n";
    EXPECT_TRUE(text.ends_with(log)) << text;
    EXPECT_EQ(Run({"--replay", file_}), kExitOk);
    EXPECT_TRUE(text_.ends_with(log)) << text_;
  }
}

}  // namespace
}  // namespace collision::server
