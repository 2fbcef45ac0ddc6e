// The limits of everything that crosses the network, once for service and clients.
//
// Bounds on lengths repeat those of collision.idl, which an IDL compiler cannot export to here; a
// test compares the two. Bounds on numbers keep every intermediate result of the core finite (the
// polynomial of a pair reaches the fourth power of a distance) and far from magnitudes at which
// doubles are coarse. Each one is generous against anything that exists.
//
// A client refuses a value beyond its limit before it is sent (client/library/validation.h, of
// shapes client/library/shape/shape.cc); the service refuses it again and tells the sender
// (server/codec/codec.h, of shapes server/shapes/shape_decoding.cc). A service may allow less
// (config/README.md, Limits).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace collision::wire {

// Numbers. All are finite; magnitudes lie in [0, limit], components in [-limit, limit].

inline constexpr double kCoordinateMax = 1e15;    ///< [m] A tenth of a light year.
inline constexpr double kSpeedMax = 1e9;          ///< [m/s] Three times the speed of light.
inline constexpr double kAccelerationMax = 1e18;  ///< [m/s²], [rad/s²] Beyond any impact.
inline constexpr double kJerkMax = 1e18;          ///< [m/s³] Likewise.
inline constexpr double kRadiusMax = 1e12;  ///< [m] Beyond Jupiter's orbit; also position errors.
inline constexpr double kAngularSpeedMax = 1e9;  ///< [rad/s]
inline constexpr double kTimeStepMax = 3600;     ///< [s] The step of a sender's integrator.

/// [m] A margin is 0 or at least this: with less, triangles grown by it would be too small.
inline constexpr double kMarginMin = 1e-6;

/// [rad] π rounded up: an orientation that may be off by this is unknown.
inline constexpr double kRotationErrorMax = 3.1415926535897936;

/// [ns] 146 years on either side of the epoch, so that the difference of two instants fits int64.
inline constexpr std::int64_t kInstantMax = std::int64_t{1} << 62;

/// How far the length of a unit vector or quaternion may be from 1.
inline constexpr double kUnitTolerance = 1e-3;

/// Relative. A shape may stand out of the ball of its agent by this much: the farthest vertex and
/// the radius that its owner computed from the same numbers differ by rounding.
inline constexpr double kShapeRadiusTolerance = 1e-9;

// Counts.

inline constexpr std::uint32_t kSlotMax = 65535;  ///< Slots are reused, so 65536 are enough.
inline constexpr int kStatesPerChunkMax = 64;     ///< Slots in a chunk of states or clearances.
inline constexpr int kStatesPerSampleMax = 128;   ///< With those before them that count too.
inline constexpr int kClassesMax = 31;  ///< Named classes of agents; with the one without, 32.
inline constexpr int kLevelsMax = 8;    ///< Levels of one service.
inline constexpr std::uint32_t kDomainMax = 230;  ///< Higher DDS domains have ports beyond 65535.
inline constexpr std::size_t kShapeTrianglesMax = 5'000'000;  ///< Of one shape, in any service.
inline constexpr std::size_t kShapeSolidsMax = 65536;         ///< Convex solids of one shape.

/// Points of all hulls of one shape together: they take memory beside the bytes that bring them.
inline constexpr std::size_t kShapeHullPointsMax = std::size_t{1} << 20;

/// [ns] A service not heard of for so long counts as gone, and what it promised has expired.
inline constexpr std::int64_t kServiceLease = 2'000'000'000;

// Watches (Watch). A simulator heeds the newest of so many watchers, and ignores a period or lease
// out of range: those who look cost it a bounded number of states.

inline constexpr std::size_t kWatchersMax = 8;
inline constexpr std::int64_t kWatchPeriodMin = 20'000'000;         ///< [ns] 50 a second.
inline constexpr std::int64_t kWatchPeriodMax = 3'600'000'000'000;  ///< [ns]
inline constexpr std::int64_t kWatchLeaseMax = 60'000'000'000;      ///< [ns]

/// The revision of the wire that this program speaks, as in collision.idl.
inline constexpr std::uint32_t kWireRevision = 3;

// Histories [samples].

/// Contacts that the service's writer keeps for a reader that has stopped, and a reader for a
/// program that has: 10 s at 1,000 contacts a second, each told three times. They take memory
/// (about 0.4 kB each) only while they wait.
inline constexpr int kContactsKept = 32768;

/// Likewise revisions of the forecast of a pair. Only the newest counts; but if that says that the
/// pair is in contact, the one before it says that this was told as possible.
inline constexpr int kForecastsKept = 2;

/// The counter of the status that tells the number of the last contact published.
inline constexpr std::string_view kContactsCounter = "contacts_published";

/// The extension of the status that tells, in turn, which runs the service has ended.
inline constexpr std::string_view kEndedRunsExtension = "ended_runs";

/// The extension of the status that says where the service runs: "pid 1234 on host-a".
inline constexpr std::string_view kProcessExtension = "process";

/// Contacts that reach a reader that joins later. They stay in memory for good.
inline constexpr int kContactsForLateJoiners = 1024;

// Lengths of texts [bytes] and of lists, as in collision.idl.

inline constexpr std::size_t kNameMax = 64;          ///< Of worlds, simulators, agents, assemblies.
inline constexpr std::size_t kLabelMax = 64;         ///< Of frames, epochs, versions.
inline constexpr std::size_t kClassNameMax = 32;     ///< AgentDescription::class_name.
inline constexpr std::size_t kLevelNameMax = 32;     ///< CollisionEvent::level.
inline constexpr int kPartnersListedMax = 16;        ///< Each list of names of a description.
inline constexpr std::size_t kRefusedFieldMax = 64;  ///< Rejection::field.
inline constexpr std::size_t kBreachFieldMax = 64;   ///< AgentBreach::field.
inline constexpr std::size_t kRefusalDetailMax = 256;   ///< Rejection::detail.
inline constexpr std::size_t kExtensionValueMax = 256;  ///< KeyValue::value.
inline constexpr int kTagsMax = 16;                     ///< AgentDescription::tags.
inline constexpr std::size_t kTagKeyMax = 32;           ///< Tag::key.
inline constexpr std::size_t kTagValueMax = 64;         ///< Tag::value.
inline constexpr int kHelloExtensionsMax = 16;          ///< ServiceHello, SimulatorHello.
inline constexpr int kRegionsMax = 64;                  ///< ServiceHello::regions.
inline constexpr int kWatchAgentsMax = 64;              ///< Watch::agents.
inline constexpr int kEventExtensionsMax = 8;           ///< CollisionEvent::extensions.
inline constexpr int kReportRefusalsMax = 16;           ///< SimulatorReport::refusals.
inline constexpr int kStatusExtensionsMax = 32;         ///< ServiceStatus::extensions.
inline constexpr int kStatusSimulatorsMax = 64;         ///< ServiceStatus::simulators.
inline constexpr int kStatusCountersMax = 96;           ///< ServiceStatus::counters.
inline constexpr int kStatusLeftOutMax = 32;            ///< ServiceStatus::left_out.
inline constexpr std::size_t kStatusLeftOutTextMax = 160;
inline constexpr std::size_t kStatusBuildMax = 96;
inline constexpr int kStatusHistogramsMax = 8;
inline constexpr int kHistogramCountsMax = 48;           ///< Histogram::counts.
inline constexpr int kSimulatorQuotasMax = 8;            ///< SimulatorStatus::quotas.
inline constexpr std::size_t kStatusRefusedWhyMax = 96;  ///< SimulatorStatus::refused_why.
inline constexpr std::size_t kStatusBroadPhaseMax = 64;
inline constexpr std::size_t kStatusBroadPhaseWhyMax = 256;

/// Bytes of a part of a shape; the last part may be shorter, none is empty.
inline constexpr std::uint64_t kShapePartBytes = 49152;

/// What a name of a world or simulator may be, for error texts.
inline constexpr char kNameText[] = "1 to 64 of A-Z a-z 0-9 _ -";
static_assert(kNameMax == 64, "the text says so");

/// Whether a text may name a world or simulator. Names are parts of DDS partitions, in which '.'
/// separates and '*' and '?' are wildcards.
constexpr bool IsName(std::string_view text) {
  for (const char c : text) {
    const bool is_letter = ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z');
    if (!is_letter && !('0' <= c && c <= '9') && c != '_' && c != '-') return false;
  }
  return !text.empty() && text.size() <= kNameMax;
}

}  // namespace collision::wire
