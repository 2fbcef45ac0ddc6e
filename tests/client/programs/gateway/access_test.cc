// Goal:   a browser shows the gateway to its own pages and to those that are named, and nobody
//         without the token gets anything; programs are let in by the token alone.
#include "client/programs/gateway/web/access.h"

#include <gtest/gtest.h>

namespace collision::gateway {
namespace {

int StatusOf(const AccessRules& rules, const RequestHead& head) {
  const auto refusal = JudgeAccess(rules, head);
  EXPECT_TRUE(!refusal || !refusal->why.empty());
  return refusal ? refusal->status : 200;
}

TEST(Access, OnlyOwnNamesCount) {
  AccessRules rules{.hosts = {"lab.example"}};
  for (const char* host : {"localhost", "LocalHost:8787", "127.0.0.1:1", "[::1]:8787", "[::1]",
                           "lab.example", "lab.example:80"}) {
    EXPECT_EQ(StatusOf(rules, {.host = host}), 200) << host;
  }
  for (const char* host :
       {"", "evil.example", "localhost.evil.example:8787", "127.0.0.1.x", "lab.example.", "::1"}) {
    EXPECT_EQ(StatusOf(rules, {.host = host}), 421) << host;
  }
}

TEST(Access, PagesFromElsewhereAreRefused) {
  const AccessRules rules{.origins = {"https://app.foxglove.dev"}};
  const auto from = [&](const char* origin) {
    return StatusOf(rules, {.host = "127.0.0.1:8787", .origin = origin});
  };
  EXPECT_EQ(from(""), 200) << "a program sends none";
  EXPECT_EQ(from("http://127.0.0.1:8787"), 200);
  EXPECT_EQ(from("https://127.0.0.1:8787"), 200) << "behind a proxy that encrypts";
  EXPECT_EQ(from("https://app.foxglove.dev"), 200);
  EXPECT_EQ(from("http://app.foxglove.dev"), 403);
  EXPECT_EQ(from("http://localhost:8787"), 403) << "another name is another origin";
  EXPECT_EQ(from("http://127.0.0.1:8788"), 403);
  EXPECT_EQ(from("null"), 403);
}

TEST(Access, TheTokenIsRequiredWhereThereIsOne) {
  const AccessRules rules{.token = "0123456789abcdef"};
  const auto with = [&](RequestHead head) {
    head.host = "localhost";
    return StatusOf(rules, head);
  };
  EXPECT_EQ(with({}), 401);
  EXPECT_EQ(with({.authorization = "Bearer 0123456789abcdef"}), 200);
  EXPECT_EQ(with({.authorization = "Bearer 0123456789abcdeF"}), 401);
  EXPECT_EQ(with({.authorization = "Bearer 0123456789abcde"}), 401);
  EXPECT_EQ(with({.authorization = "Basic 0123456789abcdef"}), 401);
  EXPECT_EQ(with({.cookie = "a=1; collision-token=0123456789abcdef; b=2"}), 200);
  EXPECT_EQ(with({.cookie = "xcollision-token=0123456789abcdef"}), 401);
  EXPECT_EQ(with({.query = "a=1&token=0123456789abcdef"}), 200);
  EXPECT_EQ(with({.query = "token=%30123456789abcdef"}), 200);
  EXPECT_EQ(with({.query = "token="}), 401);
  EXPECT_FALSE(QueryHasToken({}, "token=")) << "no token is nobody's";
}

TEST(Access, PercentSignsAreDecoded) {
  EXPECT_EQ(DecodePercent("/a%20b%2F"), "/a b/");
  EXPECT_EQ(DecodePercent("%"), std::nullopt);
  EXPECT_EQ(DecodePercent("%2"), std::nullopt);
  EXPECT_EQ(DecodePercent("%zz"), std::nullopt);
  EXPECT_EQ(QueryValue("a=1&b=2", "b"), "2");
  EXPECT_EQ(QueryValue("ab=1", "b"), std::nullopt);
  EXPECT_EQ(QueryValue("", "b"), std::nullopt);
}

}  // namespace
}  // namespace collision::gateway
