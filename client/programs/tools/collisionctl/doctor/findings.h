// What the doctor has seen of a world and its network, and what follows from it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "client/programs/shared/world_view.h"
#include "client/programs/tools/collisionctl/doctor/interfaces.h"
#include "idl/dds/neighbours/neighbours.h"

namespace collision::client {

struct DoctorSeen {
  std::string world;
  std::uint32_t domain = 0;
  double waited_s = 0;
  /// Why DDS is not available; empty: it is. Otherwise nothing else has been seen.
  std::string failure = {};
  std::string failure_lines = {};  ///< What Cyclone DDS has said of it.
  std::string profile = {};        ///< CYCLONEDDS_URI; empty: it is not set.
  DdsNeighbours neighbours = {};
  /// As a program without credentials sees them; looked for only where this one has some and nobody
  /// serves.
  DdsNeighbours without_credentials = {};
  std::vector<Interface> interfaces = {};
  std::string own_address = {};  ///< At which this program speaks; empty: not known.
  /// Other domains in which the world is served; looked for only where nobody serves it here.
  std::vector<std::uint32_t> elsewhere = {};
  std::string host = {};         ///< Asked by unicast, too; empty: none was.
  bool has_credentials = false;  ///< Of this program.
  bool host_answers = false;     ///< By unicast, though it is not heard by multicast.
  std::string unreadable = {};   ///< MessageMonitor::unreadable().
};

/// One trouble.
struct Finding {
  std::string matter;    ///< A short constant word, for programs: "no-service".
  std::string what;      ///< One sentence.
  std::string advice;    ///< What to type, or to change.
  bool is_note = false;  ///< Nothing fails; an operator should know.
};

/// The worlds that have a service among these, sorted.
std::vector<std::string> WorldsServed(const DdsNeighbours& neighbours);

/// In the order in which they are to be mended. `view`: what has been received of the world.
std::vector<Finding> Findings(const DoctorSeen& seen, const WorldView& view);

/// Whether there are notes at most.
bool IsWell(const std::vector<Finding>& findings);

/// The page; if all is well it says so.
std::string DoctorPage(const DoctorSeen& seen, const WorldView& view,
                       const std::vector<Finding>& findings);

/// A document of kind "doctor", one line without a newline.
std::string DoctorJson(const std::vector<Finding>& findings);

}  // namespace collision::client
