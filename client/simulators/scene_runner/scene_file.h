// The scenes on offer, from config/scenes/*.textproto.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "idl/scene.pb.h"

namespace collision::client {

/// Where a runner finds what it needs.
struct Folders {
  std::string scenes;  ///< Scene files; the network profile lies in the folder above.
  std::string data;    ///< Real data sets; may be empty: scenes that need one are not offered.
  std::string bin;     ///< collisiond and the simulators.
};

/// The folders of the build this program belongs to.
Folders DefaultFolders();

/// There is no scene of that name; the text names those there are.
class NoSuchScene : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws NoSuchScene, or std::runtime_error with file, line and field if the scene is malformed or
/// its data is not there.
v1::Scene LoadScene(const Folders& folders, const std::string& name);

/// Sets fields of the service's configuration over the scene's own. Throws std::invalid_argument if
/// `text` is not the protobuf text of some.
void ChangeConfig(const std::string& text, v1::Scene* scene);

/// "name  title" of every scene, one a line, with why it is not offered where it is not.
std::string ListScenes(const Folders& folders);

/// Replaces ${NAME} by its value. Throws std::runtime_error for a name that is not among them.
std::string Substitute(const std::string& text, const std::map<std::string, std::string>& values);

}  // namespace collision::client
