// Agents' positions over time, from a user's CSV file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "collision/types.h"

namespace collision::client {

struct CsvRow {
  std::int64_t time_ns = 0;  ///< File time, rounded to the nearest nanosecond.
  Vector3 position_m{};
  Vector3 velocity_m_s{};  ///< Zero without velocity columns.
  std::size_t line = 0;    ///< Of the file, from 1.
  bool jump = false;       ///< The agent did not move here from its row before.
};

struct CsvRows {
  bool velocities = false;                          ///< The file gives velocities.
  std::map<std::string, std::vector<CsvRow>> rows;  ///< By agent_id; times strictly increase.
};

/// A malformed file: "file:line: cause".
class CsvError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads a file whose first line names the columns, units in the names, in any order:
///   time_s | time_ms | time_ns,  agent_id,  x_m, y_m [, z_m],  [vx_m_s, vy_m_s [, vz_m_s]]
/// Lengths may be in mm, m or km (x_km, vx_km_s). A column `jump` is 1 where the agent did not move
/// from its row before but is set to this place, else 0. Other columns are ignored; without a
/// column z is 0. A byte-order mark is skipped; names and values may be in double quotes. Rows of
/// different agents may be in any order. `name` is used in messages. Throws CsvError for a missing
/// or duplicate column, a wrong number of columns, a number that is not finite, a time that does
/// not increase, a jump that is neither 0 nor 1, no rows.
CsvRows ReadCsv(std::istream& text, const std::string& name);

}  // namespace collision::client
