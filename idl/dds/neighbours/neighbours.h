// Who is on the network, whether or not we can understand each other.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace collision {

namespace dds {
class Credentials;
}

/// A program that takes part in a domain, as it describes itself. Empty: it does not say, as those
/// of other vendors.
struct DdsProgram {
  std::string process = {}, pid = {}, host = {};
  std::string addresses = {};  ///< "127.0.0.1", or several with commas; of this process none.
  bool is_own = false;         ///< It is this process.
};

/// A reader or writer of one of the topics of the project, of any revision.
struct DdsPeer {
  std::uint64_t program = 0;  ///< Key of DdsNeighbours::programs.
  bool writes = false;
  std::string topic = {};                    ///< Such as "collision/v1/contact".
  std::vector<std::string> partitions = {};  ///< None: the default one, "".
  /// Why it can never meet the other end as this program would make it: what differs, and in which
  /// way. Empty: it can.
  std::string misfit = {};
};

struct DdsNeighbours {
  std::map<std::uint64_t, DdsProgram> programs;
  std::vector<DdsPeer> peers;
};

/// The address at which this process speaks in a domain, by its network profile: "10.0.0.7"; empty
/// where DDS is not available there, or does not tell. Sets CYCLONEDDS_URI meanwhile. Requires that
/// the process has no participant in the domain, and no thread that reads the environment. Throws
/// std::runtime_error without headroom (idl/dds/headroom.h).
std::string OwnDdsAddress(std::uint32_t domain);

/// A participant that looks on. One thread.
class DdsLookout {
 public:
  /// `credentials`: a folder of them, for a reader in `world`; empty: none. Throws
  /// std::runtime_error, with the cause, if DDS is not available in this domain.
  explicit DdsLookout(std::uint32_t domain, const std::string& credentials = {},
                      const std::string& world = {});
  DdsLookout(DdsLookout&& other) noexcept;
  DdsLookout& operator=(DdsLookout&&) = delete;
  ~DdsLookout();

  /// All that is there now. Others are heard within about a second of the construction.
  DdsNeighbours Look() const;

 private:
  /// The services of a secured world take a program without readers and writers for a stranger.
  void ShowReader(const std::string& world) const;

  std::unique_ptr<const dds::Credentials> credentials_;  ///< Null: it is not secured.
  int participant_ = 0;
  int programs_ = 0, writers_ = 0, readers_ = 0;
};

}  // namespace collision
