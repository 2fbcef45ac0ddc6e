// Goal:   a replay can begin with any segment of the flight recorder, and finds from there on the
//         contacts that the service found.
// Method: the crowd of the golden run, on a network that loses, repeats and reorders, recorded in
//         small segments. Each segment is replayed, alone and to the end of the run; contacts of
//         equal pairs must overlap, both ways.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "idl/shape_bytes.h"
#include "server/recording/replay/replay.h"
#include "server/recording/replay/segment_chain.h"
#include "tests/simulation/scenario.h"
#include "tests/support/meshes.h"
#include "tests/support/temporary_path.h"
#include "tests/support/written_at_once.h"

namespace collision::server {
namespace {

constexpr std::int64_t kEnd = 40 * kSecond;

using Pair = std::pair<std::string, std::string>;

struct Contact {
  Pair pair;
  v1::CollisionEvent event;  ///< Its newest revision.
};

std::string NameOf(const v1::AgentId& id) {
  return std::to_string(id.simulator_id()) + ":" + std::to_string(id.slot()) + ":" +
         std::to_string(id.generation());
}

/// The contacts that were published, each in its newest revision.
std::vector<Contact> ContactsOf(const std::vector<v1::Output>& outputs) {
  std::map<std::tuple<Pair, std::uint32_t>, v1::CollisionEvent> newest;
  for (const v1::Output& output : outputs) {
    const v1::CollisionEvent& event = output.collision_event();
    if (event.contacts_sequence() == 0) continue;
    newest[{{NameOf(event.lower()), NameOf(event.higher())}, event.contact()}] = event;
  }
  std::vector<Contact> contacts;
  for (const auto& [key, event] : newest) contacts.push_back({std::get<0>(key), event});
  return contacts;
}

bool Overlap(const v1::CollisionEvent& a, const v1::CollisionEvent& b) {
  const auto end = [](const v1::CollisionEvent& one) {
    return one.has_end() ? one.end().latest_ns() : std::numeric_limits<std::int64_t>::max();
  };
  return a.begin().earliest_ns() <= end(b) && b.begin().earliest_ns() <= end(a);
}

bool BeginsOverlap(const v1::CollisionEvent& a, const v1::CollisionEvent& b) {
  return a.begin().earliest_ns() <= b.begin().latest_ns() &&
         b.begin().earliest_ns() <= a.begin().latest_ns();
}

bool IsCertain(const v1::CollisionEvent& event) { return event.status() != v1::EVENT_UNDECIDED; }

/// Those certain ones of `wanted` that may still go on after `from_ns`, and are not in `found`.
std::string Missing(const std::vector<Contact>& wanted, const std::vector<Contact>& found,
                    std::int64_t from_ns) {
  std::string missing;
  for (const Contact& one : wanted) {
    const std::int64_t end_ns = one.event.has_end() ? one.event.end().earliest_ns() : kEnd;
    if (!IsCertain(one.event) || end_ns <= from_ns) continue;
    // Where a replay begins, what goes on then has begun before.
    const bool begins_later =
        one.event.begin().earliest_ns() > from_ns && !one.event.began_before();
    const bool is_there = std::ranges::any_of(found, [&](const Contact& other) {
      if (other.pair != one.pair) return false;
      const bool is_begin = begins_later && !other.event.began_before() && IsCertain(other.event);
      return is_begin ? BeginsOverlap(one.event, other.event) : Overlap(one.event, other.event);
    });
    if (is_there) continue;
    missing += one.pair.first + " × " + one.pair.second + " begin " +
               one.event.begin().ShortDebugString() + " end " + one.event.end().ShortDebugString() +
               " " + v1::EventStatus_Name(one.event.status()) + "\n";
    for (const Contact& other : found) {
      if (other.pair != one.pair) continue;
      missing += "  there: begin " + other.event.begin().ShortDebugString() + " end " +
                 other.event.end().ShortDebugString() + " " +
                 v1::EventStatus_Name(other.event.status()) + "\n";
    }
  }
  return missing;
}

struct Replayed {
  std::vector<v1::Output> outputs;
  std::uint64_t hash = 0;
  std::int64_t begin_ns = 0;  ///< Where the world's time was after the first step.
  std::string error;
};

Replayed Replay(const std::string& path, const ReplayRange& range = {}) {
  Replayed replayed;
  SegmentChain chain(path, range);
  EXPECT_TRUE(chain.NextRun([](const std::string& cause) { ADD_FAILURE() << cause; }));
  ReplaySource source(chain, [&](const v1::Output& output) { replayed.outputs.push_back(output); });
  Daemon daemon(chain.config(), source, source, {.claim = chain.claim()});
  while (daemon.Step()) {
  }
  replayed.hash = daemon.event_log().hash();
  replayed.error = chain.error();
  for (const v1::Output& output : replayed.outputs) {
    if (output.clearance().now_ns() == 0) continue;
    replayed.begin_ns = output.clearance().now_ns();
    break;
  }
  return replayed;
}

/// A body that told its shape and its state before all but the first segment, and balls that reach
/// it one after the other. Ball by ball the two would touch a second earlier.
void AddBodyAtRest(Scenario* scenario) {
  const geometry::TriangleMesh mesh = Rod(1.2, 0.15);
  ShapeContent content;
  for (const auto& p : mesh.vertices) content.vertices.push_back({p.x(), p.y(), p.z()});
  content.triangles = mesh.triangles;
  std::vector<SimulatedAgent> balls;
  for (int i = 0; i < 7; ++i) {
    balls.push_back({.radius = 0.2,
                     .acceleration_max = 0.01,
                     .motion = Straight({0, 0, -4.0 - 5 * i}, {0, 0, 1}, kEnd)});
  }
  scenario->Add({.name = "alpha", .sender = 1, .period_ns = 100'000'000, .end_ns = kEnd}, balls);
  scenario->Add({.name = "beta", .sender = 2, .period_ns = kEnd / 2, .end_ns = kEnd},
                {{.radius = 1.3,
                  .motion = Straight({0, 0, 0}, {0, 0, 0}, kEnd),
                  .shape_bytes = EncodeShape(content)}});
}

class SegmentsOfARun : public testing::Test {
 protected:
  SegmentsOfARun() { std::filesystem::remove_all(folder_); }
  ~SegmentsOfARun() override { std::filesystem::remove_all(folder_); }

  /// Records a run of two simulators, which `add` adds, in segments of about so many bytes. Returns
  /// their paths.
  std::vector<std::string> Record(std::uint64_t bytes, const std::function<void(Scenario*)>& add) {
    Segments segments({.folder = folder_,
                       .world_and_domain = "default.0",
                       .suffix = ".rec",
                       .limits = {.bytes_max = 1 << 30}},
                      {.bytes = bytes, .age_ns = 1000 * kSecond}, config_, {}, 1);
    WrittenAtOnce flight(&segments);
    Scenario scenario(config_, Lossy(5));
    add(&scenario);
    scenario.StartService(nullptr, nullptr, &flight);
    scenario.StartSimulators();
    scenario.Run();
    segments.End();
    live_ = ContactsOf(scenario.published());
    hash_ = scenario.daemon().event_log().hash();
    EXPECT_EQ(segments.failure(), "");
    std::vector<std::string> paths;
    for (const auto& file : wire::KeptFilesIn(folder_, ".rec")) paths.push_back(file.path);
    return paths;
  }

  const v1::Config config_ = ConfigFor(2);
  const std::string folder_ = TemporaryPath("segments_of_a_run");
  std::vector<Contact> live_;
  std::uint64_t hash_ = 0;
};

TEST_F(SegmentsOfARun, AReplayFromAnySegmentFindsTheContactsFromThereOn) {
  const std::vector<std::string> paths =
      Record(60'000, [](Scenario* scenario) { AddCrowds(kEnd, scenario); });
  ASSERT_GT(paths.size(), 8u);
  ASSERT_GT(live_.size(), 40u);
  for (std::size_t i = 0; i < paths.size(); i += 2) {
    SCOPED_TRACE(paths[i]);
    const ReplayRange range{.from_ns = wire::KeptFilesIn(folder_, ".rec")[i].begin_ns};
    const Replayed replayed = Replay(folder_, range);
    EXPECT_EQ(replayed.error, "");
    const std::vector<Contact> found = ContactsOf(replayed.outputs);
    EXPECT_EQ(Missing(live_, found, replayed.begin_ns), "") << "begins " << replayed.begin_ns;
    EXPECT_EQ(Missing(found, live_, replayed.begin_ns), "");
    if (i == 2) {
      EXPECT_EQ(Replay(folder_, range).hash, replayed.hash) << "a replay is deterministic";
    }
    for (const v1::Output& output : replayed.outputs) {
      ASSERT_FALSE(output.has_rejection() &&
                   output.rejection().reason() == v1::REJECTED_CLOCK_BEYOND_GRANT)
          << output.ShortDebugString();
    }
    if (i > 0) {
      SegmentChain chain(folder_, range);
      ASSERT_TRUE(chain.NextRun([](const std::string&) {}));
      EXPECT_LE(replayed.begin_ns, chain.Next()->granted_ns())
          << "it serves, and time goes on, at once";
      continue;
    }
    EXPECT_EQ(replayed.hash, hash_) << "the first segment begins with the service";
  }
}

// Goal:   what was told once, before the segment, counts: states and shapes.
TEST_F(SegmentsOfARun, AReplayHasTheStatesAndShapesFromBeforeItsSegment) {
  const std::vector<std::string> paths = Record(15'000, AddBodyAtRest);
  ASSERT_GT(paths.size(), 5u);
  ASSERT_GE(live_.size(), 5u);
  for (const std::string& path : paths) {
    SCOPED_TRACE(path);
    const Replayed replayed = Replay(
        folder_, {.from_ns = wire::KeptFilesIn(folder_, ".rec")[&path - paths.data()].begin_ns});
    EXPECT_EQ(replayed.error, "");
    const std::vector<Contact> found = ContactsOf(replayed.outputs);
    EXPECT_EQ(Missing(live_, found, replayed.begin_ns), "") << "begins " << replayed.begin_ns;
    EXPECT_EQ(Missing(found, live_, replayed.begin_ns), "");
    for (const Contact& one : found)
      EXPECT_TRUE(IsCertain(one.event)) << "a shape is missing: " << one.event.ShortDebugString();
  }
}

}  // namespace
}  // namespace collision::server
