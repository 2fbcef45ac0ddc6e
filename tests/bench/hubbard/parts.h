// What is measured of the spaceship simulator, and the table of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/bench/harness/options.h"
#include "tests/bench/harness/report.h"
#include "tests/bench/hubbard/loop.h"

namespace collision::bench {

struct HubbardSettings : CommonOptions {
  std::string scenes_dir;

  std::int64_t frames() const { return quick ? 300 : 900; }
  int repetitions() const { return quick ? 2 : 3; }
};

struct HubbardRow {
  std::string part;   ///< narrow, both phases, or service.
  std::string scene;  ///< "20 drones, 2000 m3"
  std::string method;
  double seconds = 0;  ///< Of a pair test, median; of a frame, mean.
  std::string hash;    ///< Of the contacts of each frame.
  std::string remark;
  std::vector<Field> more;

  std::string path() const { return part + "/" + scene + "/" + method; }
  std::string Line() const;
  std::string Json() const;
};

struct HubbardReport : RowReport<HubbardRow> {
  HubbardReport();
};

/// False: the meshes are not there.
bool MeasureHubbard(const HubbardSettings& settings, HubbardReport* report);

/// One flight: the exact comparison alone, over the pairs whose balls overlap; and both phases.
struct HubbardScene {
  std::string name;
  const ShipKind& spaceship;
  const ShipKind& drone;
  const Flight& flight;
  FlightOptions options;
};
void NarrowRows(const HubbardSettings& settings, const HubbardScene& scene, HubbardReport* report);
void BothRows(const HubbardSettings& settings, const HubbardScene& scene, HubbardReport* report);
/// The detector itself, at several budgets a frame.
void ServiceRows(const HubbardSettings& settings, const HubbardScene& scene, HubbardReport* report);

/// Named, not measured.
HubbardRow RowOf(const std::string& part, const HubbardScene& scene, const std::string& method);

}  // namespace collision::bench
