// What is fuzzed: each function takes any bytes at all, and throws BrokenPromise where an answer is
// not what it must be. It keeps nothing from one input to the next.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

#include "tests/fuzz/fuzzed_data.h"

namespace collision::fuzz {

/// An answer that may not be, as one sentence with the values.
struct BrokenPromise : std::logic_error {
  using std::logic_error::logic_error;
};

template <typename... Parts>
void Require(bool holds, const Parts&... parts) {
  if (holds) return;
  std::ostringstream text;
  text.precision(17);
  (text << ... << parts);
  throw BrokenPromise(text.str());
}

/// Messages of every input topic, well-formed ones with spoilt fields and any protobuf bytes,
/// through the network's types into a daemon.
void FuzzCodec(Bytes bytes);

/// Samples of any topic as they arrive from the network, in any encoding.
void FuzzWire(Bytes bytes);

/// A configuration's text.
void FuzzConfig(Bytes bytes);

/// A recording's file, and its replay.
void FuzzRecording(Bytes bytes);

/// A mesh file: the first byte says of which format.
void FuzzMeshFile(Bytes bytes);

/// A shape's bytes as they travel, its trees, and a tree from the cache that may be damaged.
void FuzzShape(Bytes bytes);

/// Calls to detectors that differ in their broad phase only, which must answer alike.
void FuzzDetector(Bytes bytes);

/// Two bodies in motion, and when they touch.
void FuzzContact(Bytes bytes);

struct Target {
  const char* name;
  void (*run)(Bytes);
};

inline constexpr Target kTargets[] = {
    {"codec", FuzzCodec},         {"wire", FuzzWire},          {"config", FuzzConfig},
    {"recording", FuzzRecording}, {"mesh_file", FuzzMeshFile}, {"shape", FuzzShape},
    {"detector", FuzzDetector},   {"contact", FuzzContact},
};

}  // namespace collision::fuzz
