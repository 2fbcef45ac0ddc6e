// Goal:   what the service measures of itself counts each contact once, when it has left, and from
//         when the oldest input of its step arrived; without a meter no time is measured.
#include "server/publish/measurements.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <numeric>
#include <string>

namespace collision::server {
namespace {

using std::chrono::nanoseconds;
using std::chrono::seconds;

v1::CollisionEvent Contact(std::int64_t earliest_ns, std::int64_t latest_ns) {
  v1::CollisionEvent event;
  event.set_status(v1::EVENT_CONFIRMED);
  event.mutable_begin()->set_earliest_ns(earliest_ns);
  event.mutable_begin()->set_latest_ns(latest_ns);
  return event;
}

v1::Histogram Of(const Measurements& measurements, const std::string& name) {
  v1::ServiceStatus status;
  measurements.AddTo(&status);
  for (const v1::Histogram& histogram : status.histograms()) {
    if (histogram.name() == name) return histogram;
  }
  return {};
}

std::uint64_t Values(const v1::Histogram& histogram) {
  return std::accumulate(histogram.counts().begin(), histogram.counts().end(), std::uint64_t{0});
}

TEST(Measurements, CountsABracketInTheClassOfItsWidth) {
  Measurements measurements(nullptr);
  measurements.TakeContact(Contact(100, 107));
  measurements.TakeContact(Contact(100, 100));
  // What has no end, or is not confirmed, has no width.
  measurements.TakeContact(Contact(100, std::numeric_limits<std::int64_t>::max()));
  v1::CollisionEvent ended = Contact(100, 107);
  ended.set_status(v1::EVENT_ENDED);
  measurements.TakeContact(ended);
  const v1::Histogram brackets = Of(measurements, "contact_bracket_ns");
  ASSERT_EQ(brackets.counts_size(), 4) << "up to 1, 2, 5, 10";
  EXPECT_EQ(brackets.counts(0), 1u);
  EXPECT_EQ(brackets.counts(3), 1u);
  EXPECT_EQ(Values(brackets), 2u);
}

TEST(Measurements, CountsAContactOnceAndFromItsArrival) {
  const ProcessMeter meter;
  Measurements measurements(&meter);
  measurements.BeginStep(3, seconds(1));
  measurements.TakeContact(Contact(0, 1));
  measurements.TakeContact(Contact(0, 1));
  measurements.ContactsHaveLeft();
  measurements.ContactsHaveLeft();
  measurements.EndStep();
  const v1::Histogram to_contact = Of(measurements, "update_to_contact_us");
  EXPECT_EQ(Values(to_contact), 2u);
  ASSERT_GT(to_contact.counts_size(), 18) << "a second is the last of the class that ends with it";
  EXPECT_EQ(Values(Of(measurements, "step_us")), 1u);
}

TEST(Measurements, OfAStepWithoutInputsNothingIsMeasured) {
  const ProcessMeter meter;
  Measurements measurements(&meter);
  measurements.BeginStep(0, nanoseconds(0));
  measurements.TakeContact(Contact(0, 1));
  measurements.ContactsHaveLeft();
  measurements.EndStep();
  EXPECT_EQ(Values(Of(measurements, "step_us")), 0u);
  EXPECT_EQ(Values(Of(measurements, "update_to_contact_us")), 0u);
}

TEST(Measurements, TellWhatTheProcessHasUsed) {
  const ProcessMeter meter;
  v1::ServiceStatus status;
  Measurements(&meter).AddTo(&status);
  EXPECT_FALSE(status.build().empty());
  EXPECT_GT(status.started_ns(), 1'700'000'000'000'000'000) << "2023";
  EXPECT_GE(status.uptime_ns(), 0);
  EXPECT_GT(status.memory_bytes(), 1'000'000u);
  v1::ServiceStatus without;
  Measurements(nullptr).AddTo(&without);
  EXPECT_TRUE(without.build().empty());
  EXPECT_EQ(without.histograms_size(), 1);
}

}  // namespace
}  // namespace collision::server
