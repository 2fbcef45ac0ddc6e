// The service, or what stands in for it, as a process of its own.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>

namespace collision::bench {

/// "ours": the daemon. "network": the same bus, where every chunk of states is answered at once by
/// a clearance that acknowledges it, and each jump by an event.
inline constexpr const char* kContestants[] = {"network", "ours"};

/// The system's clock, with which messages are stamped [ns since 1970].
std::int64_t WallNs();

/// Folders that "ours" uses; empty: none.
struct ServiceFolders {
  std::string credentials = {};
  std::string state = {};  ///< For the flight recorder and the journal of contacts.
};

/// The child's side: serves until it is ended. Returns the exit code.
int Serve(const std::string& contestant, const std::string& world, std::uint32_t domain,
          const ServiceFolders& folders);

/// This program again, as a service; ended with the object, and with this process.
class ServiceProcess {
 public:
  /// Throws std::runtime_error if it cannot be started.
  ServiceProcess(const std::string& contestant, const std::string& world, std::uint32_t domain,
                 const ServiceFolders& folders = {});
  ~ServiceProcess();
  ServiceProcess(const ServiceProcess&) = delete;
  ServiceProcess& operator=(const ServiceProcess&) = delete;

  /// The processor's time that it has used so far [s].
  double CpuSeconds() const;

 private:
  pid_t process_;
};

}  // namespace collision::bench
