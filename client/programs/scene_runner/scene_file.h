// The available scenes, from config/scenes/*.textproto.
#pragma once

#include <map>
#include <stdexcept>
#include <string>

#include "idl/scene.pb.h"

namespace collision::client {

/// Folders that a runner reads from.
struct Folders {
  std::string scenes;  ///< Scene files; the network profile is in the folder above.
  std::string data;    ///< Real data sets; may be empty: scenes that need one are not offered.
  std::string bin;     ///< collisiond and the simulators.
};

/// The folders of the build this program belongs to.
Folders DefaultFolders();

/// There is no scene of that name; the text lists the names.
class NoSuchScene : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws NoSuchScene; or std::runtime_error with file, line and field if the scene is malformed or
/// its data does not exist.
v1::Scene LoadScene(const Folders& folders, const std::string& name);

/// Overrides fields of the scene's service configuration. Throws std::invalid_argument if `text` is
/// not protobuf text of a configuration.
void ChangeConfig(const std::string& text, v1::Scene* scene);

/// "name  title" of every scene, one per line, with the reason if a scene is not available.
std::string ListScenes(const Folders& folders);

/// Replaces ${NAME} by its value. Throws std::runtime_error for a name without a value.
std::string Substitute(const std::string& text, const std::map<std::string, std::string>& values);

}  // namespace collision::client
