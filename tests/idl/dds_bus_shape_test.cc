// Goal:   shapes cross whole however large, reach late readers, and their disposal arrives part by
//         part, before and after it is written anew.
// Method: real DDS on loopback; waiting loops with a deadline.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "idl/identity.h"
#include "idl/shape_bytes.h"
#include "tests/idl/dds_bus_support.h"

namespace collision::server {
namespace {

constexpr std::size_t kNoLimit = 1'000'000;
const std::string kHash = Sha256("a shape");
constexpr std::uint32_t kShape = 4'000'000'000;

v1::ShapePart Part(std::uint32_t part, std::uint32_t parts, char content = 'p') {
  v1::ShapePart message;
  message.set_simulator_id(SimulatorId("a"));
  message.set_shape(kShape);
  message.set_content_hash(kHash);
  message.set_part(part);
  message.set_parts(parts);
  message.set_run(1);
  message.set_total_bytes(parts * wire::kShapePartBytes);
  message.set_bytes(std::string(wire::kShapePartBytes, content));
  return message;
}

void WriteShape(DdsSession* session, std::uint32_t parts, char content = 'p') {
  for (std::uint32_t part = 0; part < parts; ++part) session->Write(Part(part, parts, content));
  session->Flush();
}

std::set<std::uint32_t> PartsIn(const std::vector<v1::Input>& inputs, char content = 'p') {
  std::set<std::uint32_t> parts;
  for (const v1::Input& input : inputs) {
    if (input.has_shape_part() && input.shape_part().bytes().front() == content) {
      parts.insert(input.shape_part().part());
    }
  }
  return parts;
}

std::set<std::uint32_t> RemovalsIn(const std::vector<v1::Input>& inputs) {
  std::set<std::uint32_t> parts;
  for (const v1::Input& input : inputs) {
    if (!input.has_shape_removal()) continue;
    EXPECT_EQ(input.shape_removal().simulator_id(), SimulatorId("a"));
    EXPECT_EQ(input.shape_removal().shape(), kShape);
    EXPECT_NE(input.sender(), 0u);
    parts.insert(input.shape_removal().part());
  }
  return parts;
}

/// As of a mesh of a million triangles, written in one go.
constexpr std::uint32_t kManyParts = 1000;

/// 16 MiB, rounded up.
constexpr std::size_t kPartsAtOnce = 338;

TEST(DdsBusShape, ALargeShapeArrivesWholeInBoundedSteps) {
  DdsBus bus(TestWorld(), TestDomain());
  DdsSession simulator(SimulatorOptions("a"));
  std::vector<v1::Input> inputs;
  simulator.Write(SimulatorTime("a", 1));
  simulator.Flush();
  ASSERT_TRUE(ReceiveUntil(bus, &inputs, [&] { return !inputs.empty(); }));
  inputs.clear();
  WriteShape(&simulator, kManyParts);
  EXPECT_EQ(simulator.counters().writes_failed, 0u);
  const auto end = std::chrono::steady_clock::now() + kDeadline;
  while (inputs.size() < kManyParts && std::chrono::steady_clock::now() < end) {
    const std::size_t before = inputs.size();
    bus.Receive(kShort, kNoLimit, &inputs);
    EXPECT_LE(inputs.size() - before, kPartsAtOnce);
  }
  EXPECT_EQ(PartsIn(inputs).size(), kManyParts);
  EXPECT_EQ(inputs.size(), kManyParts);
}

TEST(DdsBusShape, ALateReaderReceivesTheWholeShape) {
  DdsSession simulator(SimulatorOptions("a"));
  WriteShape(&simulator, kManyParts);
  DdsBus bus(TestWorld(), TestDomain());
  std::vector<v1::Input> inputs;
  EXPECT_TRUE(ReceiveUntil(bus, &inputs, [&] { return PartsIn(inputs).size() == kManyParts; }));
}

TEST(DdsBusShape, DisposalArrivesPartByPart) {
  DdsBus bus(TestWorld(), TestDomain());
  DdsSession simulator(SimulatorOptions("a"));
  WriteShape(&simulator, 40);
  std::vector<v1::Input> inputs;
  ASSERT_TRUE(ReceiveUntil(bus, &inputs, [&] { return PartsIn(inputs).size() == 40; }));
  inputs.clear();
  simulator.RemoveShape(SimulatorId("a"), kShape, 40);
  simulator.Flush();
  EXPECT_TRUE(ReceiveUntil(bus, &inputs, [&] { return RemovalsIn(inputs).size() == 40; }));
  EXPECT_EQ(inputs.size(), 40u);
  WriteShape(&simulator, 40, 'q');
  EXPECT_TRUE(ReceiveUntil(bus, &inputs, [&] { return PartsIn(inputs, 'q').size() == 40; }));
}

// Goal:   ever-new shapes that were given up take no memory of their writer: it does not know them
//         any more.
// Method: readers that join later are told nothing of them, neither parts nor removals, once the
//         removals have been acknowledged. The part of another shape, written last, comes last.
TEST(DdsBusShape, WhatWasGivenUpIsForgotten) {
  DdsBus bus(TestWorld(), TestDomain());
  DdsSession simulator(SimulatorOptions("a"));
  WriteShape(&simulator, 40);
  simulator.RemoveShape(SimulatorId("a"), kShape, 40);
  v1::ShapePart last = Part(0, 1, 'l');
  last.set_shape(kShape + 1);
  simulator.Write(last);
  simulator.Flush();
  std::vector<v1::Input> heard;
  ASSERT_TRUE(ReceiveUntil(bus, &heard, [&] { return !PartsIn(heard, 'l').empty(); }));
  EXPECT_EQ(RemovalsIn(heard).size(), 40u);
  const auto end = std::chrono::steady_clock::now() + kDeadline;
  do {
    DdsBus late(TestWorld(), TestDomain());
    heard.clear();
    ASSERT_TRUE(ReceiveUntil(late, &heard, [&] { return !PartsIn(heard, 'l').empty(); }));
    EXPECT_TRUE(PartsIn(heard).empty());
  } while (!RemovalsIn(heard).empty() && std::chrono::steady_clock::now() < end);
  EXPECT_TRUE(RemovalsIn(heard).empty());
}

// Goal:   disposed and written again before the bus is read, each part ends as written: its last
//         message is the data.
TEST(DdsBusShape, WrittenAgainAtOnceItStays) {
  DdsBus bus(TestWorld(), TestDomain());
  DdsSession simulator(SimulatorOptions("a"));
  WriteShape(&simulator, 8);
  std::vector<v1::Input> inputs;
  ASSERT_TRUE(ReceiveUntil(bus, &inputs, [&] { return PartsIn(inputs).size() == 8; }));
  for (char round = 'A'; round < 'Z'; ++round) {
    simulator.RemoveShape(SimulatorId("a"), kShape, 8);
    WriteShape(&simulator, 8, round);
  }
  ASSERT_TRUE(ReceiveUntil(bus, &inputs, [&] { return PartsIn(inputs, 'Y').size() == 8; }));
  std::map<std::uint32_t, bool> present;
  for (const v1::Input& input : inputs) {
    if (input.has_shape_part()) present[input.shape_part().part()] = true;
    if (input.has_shape_removal()) present[input.shape_removal().part()] = false;
  }
  for (const auto& [part, there] : present) EXPECT_TRUE(there) << part;
}

TEST(DdsBusShape, OnlyASimulatorRemoves) {
  DdsSession monitor(MonitorOptions(false));
  EXPECT_THROW(monitor.RemoveShape(1, kShape, 1), std::logic_error);
}

}  // namespace
}  // namespace collision::server
