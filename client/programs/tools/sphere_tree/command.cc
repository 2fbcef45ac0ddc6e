#include "client/programs/tools/sphere_tree/command.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <new>
#include <stdexcept>
#include <system_error>

#include "client/programs/shared/command_line.h"
#include "client/programs/shared/exit_code.h"
#include "client/programs/shared/mesh_option.h"
#include "client/programs/tools/collisionctl/json/json_writer.h"
#include "client/programs/tools/collisionctl/json/message_json.h"
#include "client/programs/tools/sphere_tree/export.h"
#include "client/programs/tools/sphere_tree/picture.h"
#include "client/programs/tools/sphere_tree/report.h"

namespace collision::client {
namespace {

/// More balls cannot be told apart in a picture.
constexpr std::size_t kPictureBallsMax = 600;

/// An error of the command line, or of what it asks of this tree.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct OutputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

constexpr const char* kFooter = R"(
Examples (--mesh-unit and --mesh-up are always stated, never guessed; M: --mesh-unit 1 --mesh-up z):
  collisionctl sphere-tree ship.obj M                        every level: number and fit of balls
  collisionctl sphere-tree ship.obj M --builder octree       the reference builder instead
  collisionctl sphere-tree ship.obj M --picture ship.svg --level 3
  collisionctl sphere-tree ship.obj M --export obj --output balls.obj
  collisionctl sphere-tree ship.obj M --report json --levels 6

Overshoot is how far a ball may reach beyond the surface (its radius + the signed distance of its
centre), certified: the smaller it is, the sooner two agents are known to be apart or in contact.
Lengths are metres after --mesh-unit, in the body frame that --mesh-up makes.
Exit codes: 0 done, 2 usage, 65 the mesh is refused (the reason is printed) or does not fit into the
memory, 74 a file cannot be written.)";

OutputError CannotWrite(const std::string& path, int error) {
  return OutputError(path + ": cannot be written: " + std::generic_category().message(error));
}

/// Whether two paths name one file, also through links and dots; the file need not exist yet.
bool IsSameFile(const std::string& a, const std::string& b) {
  std::error_code error;
  if (std::filesystem::equivalent(a, b, error)) return true;
  const auto path_a = std::filesystem::weakly_canonical(a, error);
  return !error && path_a == std::filesystem::weakly_canonical(b, error) && !error;
}

/// Checks before anything is built: the output must be writable and must not replace the mesh.
void CheckOutput(const std::string& option, const std::string& path, const std::string& mesh) {
  if (path.empty()) return;
  if (IsSameFile(path, mesh)) {
    throw UsageError(option + ": " + path + " is the mesh itself, allowed: another file");
  }
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw CannotWrite(path, EISDIR);
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (!folder.empty() && !std::filesystem::exists(folder, error)) throw CannotWrite(path, ENOENT);
  if (!folder.empty() && !std::filesystem::is_directory(folder, error)) {
    throw CannotWrite(path, ENOTDIR);
  }
}

void Write(const std::string& path, const std::string& text) {
  errno = 0;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  if (!file) throw CannotWrite(path, errno != 0 ? errno : EIO);
}

void Check(const SphereTreeOptions& options) {
  if (!options.picture.empty() && !options.picture.ends_with(".svg")) {
    throw UsageError("--picture: " + options.picture + ", allowed: a name that ends in .svg");
  }
  if (!options.output.empty() && options.format.empty()) {
    throw UsageError("--output: allowed only with --export");
  }
  if (options.level && options.picture.empty() && options.format.empty()) {
    throw UsageError("--level: allowed only with --picture or --export");
  }
  CheckOutput("--picture", options.picture, options.mesh);
  CheckOutput("--output", options.output, options.mesh);
  const bool are_two = !options.picture.empty() && !options.output.empty();
  if (are_two && IsSameFile(options.picture, options.output)) {
    throw UsageError("--output: " + options.output + " is the picture, allowed: another file");
  }
}

std::uint32_t LevelOf(const SphereTreeOptions& options, const sphere_tree::SphereTree& tree) {
  if (!options.level) return LevelWithin(tree, kPictureBallsMax);
  if (*options.level < tree.levels) return *options.level;
  throw UsageError("--level: " + std::to_string(*options.level) + ", allowed: 0 to " +
                   std::to_string(tree.levels - 1) + ", the levels of this tree");
}

std::string Exported(const SphereTreeOptions& options, const MeshTree& mesh_tree,
                     std::uint32_t level) {
  if (options.format == "obj") return LevelObj(mesh_tree, level);
  if (options.format == "json") return LevelJson(mesh_tree, level);
  return TreeBinary(mesh_tree);
}

/// A document of kind "sphere-tree" with the fields of the report.
std::string ReportJson(const v1::TreeReport& report) {
  const std::string head = JsonDocument("sphere-tree").Json();
  return head.substr(0, head.size() - 1) + "," + MessageJson(report).substr(1);
}

void PrintWritten(const std::string& what, const std::string& file, std::ostream& out) {
  out << what << " written to " << file << '\n';
}

/// An export to standard output is printed without a report.
void Deliver(const SphereTreeOptions& options, const MeshTree& mesh_tree) {
  const std::uint32_t level = LevelOf(options, mesh_tree.tree());
  const bool exports_here = !options.format.empty() && options.output.empty();
  std::ostream& out = exports_here ? std::cerr : std::cout;
  const v1::TreeReport report = ReportOf(mesh_tree);
  const bool json = options.report == "json";
  if (!exports_here || !options.report.empty()) {
    out << (json ? ReportJson(report) + "\n" : ReportText(mesh_tree, report));
  }
  // JSON stays one document.
  std::ostream& notes = json ? std::cerr : out;
  if (!options.picture.empty()) {
    Write(options.picture, LevelPicture(mesh_tree, level));
    PrintWritten("level " + std::to_string(level), options.picture, notes);
  }
  if (options.format.empty()) return;
  const std::string exported = Exported(options, mesh_tree, level);
  if (exports_here) {
    std::cout << exported;
  } else {
    Write(options.output, exported);
    const bool whole = options.format == "binpb";
    PrintWritten(whole ? "the tree" : "level " + std::to_string(level), options.output, notes);
  }
}

}  // namespace

CLI::App* AddSphereTreeCommand(CLI::App* app, SphereTreeOptions* options) {
  CLI::App* command = app->add_subcommand(
      "sphere-tree", "How well the sphere tree of a mesh file fits it; needs no service");
  command->add_option("mesh", options->mesh, "OBJ, STL, PLY, glTF or GLB")->required();
  AddRequiredMeshFrameOptions(command, &options->frame);
  command->add_option("--builder", options->builder, "octree or fitted")
      ->check(OneOf({"octree", "fitted"}))
      ->capture_default_str();
  command
      ->add_option("--levels", options->levels,
                   "Levels to build at most, the root's among them, 1 to 24")
      ->check(WholeBetween(kTreeLevelsMin, kTreeLevelsMax))
      ->expected(0, 1)
      ->capture_default_str();
  command->add_option("--report", options->report, "text (also if nothing follows) or json")
      ->check(OneOf({"text", "json"}))
      ->expected(0, 1)
      ->default_str("text");
  command
      ->add_option(
          "--export", options->format,
          "obj or json: the balls of a level; binpb: the whole tree (idl/sphere_tree.proto)")
      ->check(OneOf({"obj", "json", "binpb"}));
  command->add_option("--output", options->output,
                      "File for --export; without it standard output, and no report there");
  command->add_option("--picture", options->picture, "Draws a level over the mesh: FILE.svg");
  command->add_option(
      "--level", options->level,
      "Level of --picture and --export; the last of at most 600 balls unless stated");
  command->footer(kFooter);
  return command;
}

int RunSphereTree(const SphereTreeOptions& options) {
  try {
    Check(options);
    sphere_tree::ShapeOptions build{.levels_max = options.levels - 1};
    build.builder = options.builder == "fitted" ? sphere_tree::TreeBuilder::kFitted
                                                : sphere_tree::TreeBuilder::kOctree;
    Deliver(options, BuildMeshTree(options.mesh, options.frame, build));
    std::cout.flush();
    if (!std::cout) throw OutputError("the output cannot be written");
    return 0;
  } catch (const UsageError& error) {
    std::cerr << "collisionctl: " << error.what() << '\n';
    return kExitUsage;
  } catch (const OutputError& error) {
    std::cerr << "collisionctl: " << error.what() << '\n';
    return kExitOutputFailed;
  } catch (const std::bad_alloc&) {
    std::cerr << "collisionctl: " << options.mesh << ": " << kNoMemoryText << '\n';
    return kExitBadData;
  } catch (const std::length_error&) {
    std::cerr << "collisionctl: " << options.mesh << ": " << kNoMemoryText << '\n';
    return kExitBadData;
  } catch (const std::exception& error) {
    std::cerr << "collisionctl: " << error.what() << '\n';
    return kExitBadData;
  }
}

}  // namespace collision::client
