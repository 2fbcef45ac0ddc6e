// Goal:   the end of credentials is read as it stands in the files, and told in time.
// Method: a certificate of a fixed date, made with openssl; times around each threshold; and bytes
//         that are no certificate, cut off at each length.
#include <gtest/gtest.h>

#include <string>

#include "idl/credentials/end_watch.h"
#include "idl/credentials/validity.h"

namespace collision::credentials {
namespace {

constexpr std::int64_t kHour = 3600, kDay = 24 * kHour;

constexpr std::int64_t kEnd = 1830502935;
constexpr char kEndText[] = "2028-01-03 09:02:15 UTC";
constexpr char kCertificate[] =
    R"(-----BEGIN CERTIFICATE-----
MIIBuTCCAV+gAwIBAgIUAbJftuXnRoz12etWW9reC/1+aj4wCgYIKoZIzj0EAwIw
MjEMMAoGA1UECgwDbGFiMRIwEAYDVQQLDAlzaW11bGF0b3IxDjAMBgNVBAMMBWFs
cGhhMB4XDTI2MTEyOTA5MDIxNVoXDTI4MDEwMzA5MDIxNVowMjEMMAoGA1UECgwD
bGFiMRIwEAYDVQQLDAlzaW11bGF0b3IxDjAMBgNVBAMMBWFscGhhMFkwEwYHKoZI
zj0CAQYIKoZIzj0DAQcDQgAELVggKg3N46qXcNL77NTLw811QcCcw8IhUXOBNzcK
OUYvxm8K6OhltxFNObg2/RUPUOyDk1Kt7spLRnFR0f64LKNTMFEwHQYDVR0OBBYE
FCz96fUVJS4rfdjd6XrUhH+0tdA9MB8GA1UdIwQYMBaAFCz96fUVJS4rfdjd6XrU
hH+0tdA9MA8GA1UdEwEB/wQFMAMBAf8wCgYIKoZIzj0EAwIDSAAwRQIhAPqA9zyG
jp2uTfW/DgcsuCZgdGzeT9FwteFvSnrk5nfCAiB3Szwxj1LQwv5aARfeEkWYUgzo
xGyzIIPfWpP90ave4Q==
-----END CERTIFICATE-----
)";

TEST(Validity, TheEndOfACertificateIsThatOfItsFile) {
  EXPECT_EQ(EndOfCertificate(kCertificate), kEnd);
  EXPECT_EQ(EndOfCertificate("# a comment\n" + std::string(kCertificate)), kEnd);
  EXPECT_EQ(DateText(kEnd), kEndText);
}

TEST(Validity, WhatIsNoCertificateHasNoEnd) {
  EXPECT_EQ(EndOfCertificate(""), std::nullopt);
  EXPECT_EQ(EndOfCertificate("-----BEGIN CERTIFICATE-----\n"), std::nullopt);
  const std::string whole = kCertificate;
  for (std::size_t length = 0; length + 60 < whole.size(); ++length) {
    EXPECT_EQ(EndOfCertificate(whole.substr(0, length)), std::nullopt) << length;
  }
}

TEST(Validity, OfSeveralGrantsTheFirstToEndCounts) {
  const std::string two =
      "<not_after>2027-11-29T08:18:53Z</not_after> <not_after>2026-01-01T00:00:00</not_after>";
  EXPECT_EQ(EndOfPermissions(two), 1767225600);
  EXPECT_EQ(XmlDateText(1767225600), "2026-01-01T00:00:00Z");
  EXPECT_EQ(EndOfPermissions("<not_after>soon</not_after>"), std::nullopt);
}

TEST(EndWatch, SaysEachThresholdOnceAndTheEndAgainAndAgain) {
  EndWatch watch("identity.pem", 100 * kDay);
  EXPECT_EQ(watch.Look(69 * kDay), std::nullopt);
  EXPECT_NE(watch.Look(70 * kDay)->find("identity.pem ends in 30 days"), std::string::npos);
  EXPECT_EQ(watch.Look(80 * kDay), std::nullopt);
  EXPECT_NE(watch.Look(93 * kDay)->find("ends in 7 days"), std::string::npos);
  EXPECT_NE(watch.Look(99 * kDay + kHour)->find("ends in 23 h"), std::string::npos);
  EXPECT_NE(watch.Look(100 * kDay - 60)->find("ends in 1 min"), std::string::npos);
  EXPECT_EQ(watch.Look(100 * kDay), std::nullopt);
  EXPECT_NE(watch.Look(100 * kDay + 1)->find("ended at 1970-04-11 00:00:00 UTC"),
            std::string::npos);
  EXPECT_EQ(watch.Look(100 * kDay + 60), std::nullopt);
  EXPECT_TRUE(watch.Look(100 * kDay + 61));
}

TEST(EndWatch, OneThatBeginsLateSaysTheNearestThresholdOnly) {
  EndWatch watch("identity.pem", 10 * kDay);
  EXPECT_NE(watch.Look(10 * kDay - 2 * kHour)->find("ends in 2 h"), std::string::npos);
  EXPECT_EQ(watch.Look(10 * kDay - 2 * kHour + 1), std::nullopt);
}

}  // namespace
}  // namespace collision::credentials
