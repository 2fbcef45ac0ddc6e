// Goal:   events that arrive together come in the order of their publication, after all else, which
//         keeps its order.
// Method: a batch in which a contact and a forecast have changed places.
#include "client/library/network/arrival_order.h"

#include <gtest/gtest.h>

#include <tuple>

namespace collision::client {
namespace {

TEST(ArrivalOrder, EventsFollowInTheOrderOfTheirStamps) {
  std::vector<v1::Output> outputs(5);
  outputs[0].mutable_collision_event()->mutable_stamp()->set_sequence(8);
  outputs[1].mutable_clearance()->mutable_stamp()->set_sequence(9);
  outputs[2].mutable_collision_event()->mutable_stamp()->set_sequence(7);
  outputs[3].mutable_clearance()->mutable_stamp()->set_sequence(3);
  outputs[4].mutable_collision_event()->mutable_stamp()->set_sequence(6);
  OrderEvents(&outputs);
  EXPECT_EQ(outputs[0].clearance().stamp().sequence(), 9u);
  EXPECT_EQ(outputs[1].clearance().stamp().sequence(), 3u);
  EXPECT_EQ(outputs[2].collision_event().stamp().sequence(), 6u);
  EXPECT_EQ(outputs[3].collision_event().stamp().sequence(), 7u);
  EXPECT_EQ(outputs[4].collision_event().stamp().sequence(), 8u);
}

TEST(ArrivalOrder, AnotherServiceStaysBehindTheFormer) {
  std::vector<v1::Output> outputs(3);
  for (const auto& [at, service, sequence] : {std::tuple(0, 1, 901), {1, 1, 900}, {2, 2, 1}}) {
    outputs[at].mutable_collision_event()->mutable_stamp()->set_service_id(service);
    outputs[at].mutable_collision_event()->mutable_stamp()->set_sequence(sequence);
  }
  OrderEvents(&outputs);
  EXPECT_EQ(outputs[0].collision_event().stamp().sequence(), 900u);
  EXPECT_EQ(outputs[1].collision_event().stamp().sequence(), 901u);
  EXPECT_EQ(outputs[2].collision_event().stamp().sequence(), 1u);
}

}  // namespace
}  // namespace collision::client
