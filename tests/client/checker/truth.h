// Helpers of the tests in this folder: true contacts from files, and a small run to judge.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "client/checker/motion/true_contacts.h"
#include "client/programs/simulators/motion/motion_log.h"
#include "client/programs/simulators/player/csv_rows.h"
#include "client/programs/simulators/player/trajectory.h"
#include "tests/support/temporary_path.h"

namespace collision::client {

/// The motions of all agents of a CSV file, by way of the same text as a motion log holds.
inline std::vector<checker::AgentMotion> MotionsOf(const std::string& path, double radius_m) {
  std::ifstream file(path);
  const CsvRows rows = ReadCsv(file, path);
  const std::string log_path = TemporaryPath("truth_of_" + std::to_string(radius_m) + ".motion");
  MotionLog log(log_path);
  for (const auto& [id, agent_rows] : rows.rows) {
    log.Agent(id, radius_m);
    const Trajectory trajectory(agent_rows, rows.velocities, 0);
    for (const MotionPiece& piece : trajectory.pieces()) log.Piece(id, piece);
  }
  log.Close();
  std::ifstream text(log_path);
  return checker::ReadMotionLog(text, "data");
}

}  // namespace collision::client
