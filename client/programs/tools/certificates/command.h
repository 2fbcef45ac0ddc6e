// collisionctl make-certificates: who may take part in a world. It needs no service.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace collision::client {

struct CertificateOptions {
  std::string folder;
  bool service = false;
  std::vector<std::string> simulators, monitors, operators;
  bool monitoring = false;  ///< The simulators.
  std::uint32_t days = 365;
  std::string protection = {};  ///< Empty: not said.
};

/// Where the world of new credentials is; nullopt: not said, so that it is the authority's, or the
/// default of a new one.
struct CertificatePlace {
  std::optional<std::string> world;
  std::optional<std::uint32_t> domain;
};

/// As --world and --domain of the program say, or their variables of the environment.
CertificatePlace GivenPlace(const CLI::App& app);

/// Adds the subcommand. `options` outlives `app`.
CLI::App* AddCertificatesCommand(CLI::App* app, CertificateOptions* options);

/// Makes what is asked for, all of it or nothing, and says what to copy where. Returns the exit
/// code; errors are printed on standard error.
int RunMakeCertificates(const CertificateOptions& options, const CertificatePlace& place);

}  // namespace collision::client
