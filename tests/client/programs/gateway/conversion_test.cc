// Goal:   recordings that are dropped are made one at a time; what cannot be replayed is told; a
//         replay that hangs ends with the gateway.
// Method: a program in place of collisiond that fails, or never ends.
#include "client/programs/gateway/conversion.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <future>
#include <memory>
#include <string>

#include "tests/support/temporary_path.h"

namespace collision::gateway {
namespace {

class ConversionTest : public testing::Test {
 protected:
  ConversionTest() : folder_(TemporaryPath("conversion")), path_(std::getenv("PATH")) {
    std::filesystem::create_directories(folder_);
    setenv("PATH", (folder_ + ":" + path_).c_str(), 1);
  }
  ~ConversionTest() override {
    setenv("PATH", path_.c_str(), 1);
    std::filesystem::remove_all(folder_);
  }

  void PutDaemon(const std::string& does) const {
    const std::string program = folder_ + "/collisiond";
    std::ofstream(program) << "#!/bin/sh\n" << does << "\n";
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  }

  static std::future<WebResponse> Drop(Conversion* conversion) {
    const auto answer = std::make_shared<std::promise<WebResponse>>();
    conversion->Start("bytes", [answer](WebResponse response) { answer->set_value(response); });
    return answer->get_future();
  }

  const std::string folder_, path_;
};

TEST_F(ConversionTest, WhatCannotBeReplayedIsTold) {
  PutDaemon("exit 74");
  Conversion conversion;
  for (int i = 0; i < 2; ++i) {
    const WebResponse answer = Drop(&conversion).get();
    EXPECT_EQ(answer.status, 422) << "and the next one is taken";
    EXPECT_NE(answer.body->find("cannot replay it (exit code 74)"), std::string::npos)
        << *answer.body;
  }
}

TEST_F(ConversionTest, OneAtATimeAndNoneWhenItEnds) {
  PutDaemon("exec /bin/sleep 1000");
  Conversion conversion;
  std::future<WebResponse> first = Drop(&conversion);
  EXPECT_EQ(Drop(&conversion).get().status, 503);
  conversion.Stop();
  EXPECT_EQ(first.get().status, 422) << "its replay hung";
  EXPECT_EQ(Drop(&conversion).get().status, 503);
}

}  // namespace
}  // namespace collision::gateway
