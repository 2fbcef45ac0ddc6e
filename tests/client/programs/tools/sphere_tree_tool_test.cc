// Goal:   what collisionctl sphere-tree shows, draws and exports is the tree that the service
//         builds; a wrong request gives one line and an exit code.
// Method: small meshes as files; every output is read back and compared with the tree itself.
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "client/programs/tools/sphere_tree/command.h"
#include "client/programs/tools/sphere_tree/export.h"
#include "client/programs/tools/sphere_tree/picture.h"
#include "collision_core/sphere_tree/tree_check.h"
#include "idl/tree_message.h"
#include "tests/client/programs/tools/collisionctl/json/schema_check.h"

namespace collision::client {
namespace {

namespace fs = std::filesystem;

/// Closed: a bumpy ball of 6 n² squares, as an OBJ file. `flat` makes it 0.3 times as thick along
/// z.
std::string BumpyObj(int n, bool flat) {
  std::ostringstream text;
  for (int face = 0; face < 6; ++face) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        Eigen::Vector3d p;
        const int axis = face / 2;
        p[axis] = face % 2 ? 1 : -1;
        p[(axis + 1) % 3] = (face % 2 ? 1 : -1) * (2.0 * i / n - 1);
        p[(axis + 2) % 3] = 2.0 * j / n - 1;
        p = p.normalized() * (1 + 0.2 * p.x() * p.y());
        text << "v " << p.x() << " " << p.y() << " " << p.z() * (flat ? 0.3 : 1) << "\n";
      }
    }
  }
  for (int face = 0; face < 6; ++face) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const int a = 1 + face * (n + 1) * (n + 1) + j * (n + 1) + i;
        text << "f " << a << " " << a + 1 << " " << a + n + 2 << " " << a + n + 1 << "\n";
      }
    }
  }
  return text.str();
}

class SphereTreeTool : public testing::Test {
 protected:
  SphereTreeTool()
      : folder_(testing::TempDir() + "sphere_tree_tool_test." + std::to_string(getpid()) + "." +
                testing::UnitTest::GetInstance()->current_test_info()->name()) {
    fs::create_directories(folder_);
  }
  ~SphereTreeTool() override { fs::remove_all(folder_); }

  std::string File(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ + "/" + name, std::ios::binary) << text;
    return folder_ + "/" + name;
  }
  MeshTree Tree(const std::string& name, const std::string& text) const {
    return BuildMeshTree(File(name, text), {.unit_m = 2, .up = UpAxis::kZ}, {});
  }

  const std::string folder_;
};

std::string Contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST_F(SphereTreeTool, ReportsWhatTheTreeIs) {
  const MeshTree built = Tree("ball.obj", BumpyObj(6, false));
  const v1::TreeReport report = ReportOf(built);
  EXPECT_EQ(report.triangles(), 432u);
  EXPECT_TRUE(report.closed());
  EXPECT_EQ(report.content_hash().size(), 64u);
  EXPECT_EQ(report.balls(), built.tree().nodes.size());
  ASSERT_EQ(static_cast<std::uint32_t>(report.levels_size()), built.tree().levels);
  for (const v1::TreeCutReport& level : report.levels()) {
    double greatest = 0, sum = 0;
    std::uint32_t balls = 0;
    for (const sphere_tree::SphereNode& node : built.tree().nodes) {
      if (node.level > level.level() || (node.level < level.level() && node.children > 0)) continue;
      greatest = std::max(greatest, node.radius + node.signed_distance);
      sum += node.radius + node.signed_distance;
      ++balls;
    }
    EXPECT_EQ(level.balls(), balls);
    EXPECT_NEAR(level.overshoot_max_m(), greatest, 1e-12);
    EXPECT_NEAR(level.overshoot_mean_m(), sum / balls, 1e-12);
    EXPECT_NEAR(level.overshoot_max_percent(), 100 * greatest / report.diagonal_m(), 1e-9);
  }
  ASSERT_EQ(report.cuts_size(), 3);
  for (const v1::TreeCutReport& cut : report.cuts()) EXPECT_LE(cut.balls(), cut.balls_at_most());
  // The mesh's unit is two metres.
  EXPECT_NEAR(report.diagonal_m(), 2 * std::sqrt(12.0), 1.0);
  const std::string text = ReportText(built, report);
  EXPECT_NE(text.find("closed: a solid"), std::string::npos);
  EXPECT_NE(text.find("octree: " + std::to_string(report.balls()) + " balls"), std::string::npos);
  const MeshTree open = Tree("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_NE(ReportText(open, ReportOf(open)).find("open: a surface"), std::string::npos);
}

// Goal:   each exported ball is the node's: its corners lie on it, its faces name its own corners.
TEST_F(SphereTreeTool, ExportsBallsThatOtherProgramsRead) {
  const MeshTree built = Tree("ball.obj", BumpyObj(4, false));
  const std::uint32_t level = 2;
  const std::vector<NodeIndex> cut = built.tree().Cut(level);
  std::istringstream lines(LevelObj(built, level));
  std::size_t balls = 0, corners = 0, corners_before = 0, faces = 0;
  const sphere_tree::SphereNode* node = nullptr;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "o") {
      ASSERT_LT(balls, cut.size());
      EXPECT_EQ(line, "o ball_" + std::to_string(cut[balls].value()));
      node = &built.tree().node(cut[balls++]);
      corners_before = corners;
    } else if (word == "v") {
      Eigen::Vector3d p;
      words >> p.x() >> p.y() >> p.z();
      EXPECT_NEAR((p - node->centre).norm(), node->radius, 1e-6);
      ++corners;
    } else if (word == "f") {
      for (std::size_t corner = 0; words >> corner;) {
        EXPECT_GT(corner, corners_before);
        EXPECT_LE(corner, corners);
      }
      ++faces;
    }
  }
  EXPECT_EQ(balls, cut.size());
  EXPECT_EQ(corners, 42 * balls);
  EXPECT_EQ(faces, 80 * balls);
}

TEST_F(SphereTreeTool, ExportsMessages) {
  const MeshTree built = Tree("ball.obj", BumpyObj(4, false));
  v1::TreeLevel level;
  ASSERT_TRUE(google::protobuf::util::JsonStringToMessage(LevelJson(built, 1), &level).ok());
  const std::vector<NodeIndex> cut = built.tree().Cut(1);
  ASSERT_EQ(static_cast<std::size_t>(level.balls_size()), cut.size());
  for (int i = 0; i < level.balls_size(); ++i) {
    const sphere_tree::SphereNode& node = built.tree().node(cut[i]);
    EXPECT_EQ(level.balls(i).node(), cut[i].value());
    EXPECT_EQ(level.balls(i).z_m(), node.centre.z());
    EXPECT_EQ(level.balls(i).radius_m(), node.radius);
    EXPECT_EQ(level.balls(i).signed_distance_m(), node.signed_distance);
  }
  v1::SphereTree message;
  ASSERT_TRUE(message.ParseFromString(TreeBinary(built)));
  const std::optional<sphere_tree::SphereTree> tree = FromMessage(message);
  ASSERT_TRUE(tree);
  EXPECT_EQ(RefusalOf(*tree, built.shape->mesh()), std::nullopt);
  EXPECT_EQ(tree->nodes.size(), built.tree().nodes.size());
  EXPECT_EQ(tree->nodes.back().centre, built.tree().nodes.back().centre);
}

std::size_t CountOf(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++count;
  return count;
}

/// Every tag is closed, in order.
bool IsWellFormed(const std::string& svg) {
  std::vector<std::string> open;
  for (std::size_t at = svg.find('<'); at != svg.npos; at = svg.find('<', at)) {
    const std::size_t end = svg.find_first_of("<>", at + 1);
    if (end == svg.npos || svg[end] == '<') return false;
    const std::string tag = svg.substr(at + 1, end - at - 1);
    at = end;
    const bool closes = !tag.empty() && tag[0] == '/';
    const std::string name = tag.substr(closes, tag.find_first_of(" \n/", 1) - closes);
    if (closes) {
      if (open.empty() || open.back() != name) return false;
      open.pop_back();
    } else if (tag.empty() || tag.back() != '/') {
      open.push_back(name);
    }
  }
  return open.empty() && svg.rfind("</svg>\n") == svg.size() - 7;
}

// Goal:   the picture has one circle per ball and the mesh below, seen along its shortest axis.
TEST_F(SphereTreeTool, DrawsALevelOverTheMesh) {
  const MeshTree built = Tree("a&b.obj", BumpyObj(6, true));
  for (std::uint32_t level = 0; level < built.tree().levels; ++level) {
    const std::string svg = LevelPicture(built, level);
    EXPECT_TRUE(IsWellFormed(svg));
    EXPECT_EQ(CountOf(svg, "<circle"), built.tree().Cut(level).size());
    EXPECT_GE(CountOf(svg, "<path fill"), 3u) << "tones of a round mesh";
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    EXPECT_NE(svg.find("a&amp;b.obj: octree tree, level " + std::to_string(level)), svg.npos);
  }
  // Along z: about as wide as high. Along x or y it would be three times as wide as high.
  const std::string svg = LevelPicture(built, built.tree().levels - 1);
  int width = 0, height = 0;
  ASSERT_EQ(
      std::sscanf(svg.c_str() + svg.find("viewBox"), "viewBox=\"0 0 %d %d\"", &width, &height), 2);
  EXPECT_LT(width, 1.3 * height);
}

// Goal:   thin things are drawn as well: a triangle in each plane, a needle.
TEST_F(SphereTreeTool, DrawsFlatThings) {
  for (const char* mesh :
       {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n",
        "v 0 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n", "v 0 0 0\nv 1e3 0 0\nv 0 0 1e-3\nf 1 2 3\n"}) {
    const MeshTree built = Tree("thin.obj", mesh);
    const std::string svg = LevelPicture(built, 0);
    EXPECT_TRUE(IsWellFormed(svg));
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_GE(CountOf(svg, "<path fill"), 1u);
  }
}

struct Outcome {
  int status = 0;
  std::string out, err;
};

const MeshFileOptions kFrame{.unit_m = 1, .up = UpAxis::kZ};

Outcome RunTool(const SphereTreeOptions& options) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Outcome outcome;
  outcome.status = RunSphereTree(options);
  outcome.out = testing::internal::GetCapturedStdout();
  outcome.err = testing::internal::GetCapturedStderr();
  return outcome;
}

TEST_F(SphereTreeTool, AWrongRequestIsOneLine) {
  SphereTreeOptions good;
  good.frame = kFrame;
  good.mesh = File("ball.obj", BumpyObj(3, false));
  good.builder = "octree";
  const auto with = [&](const std::function<void(SphereTreeOptions*)>& change) {
    SphereTreeOptions options = good;
    change(&options);
    return RunTool(options);
  };
  const auto expect = [](const Outcome& outcome, int status, const std::string& text) {
    EXPECT_EQ(outcome.status, status) << outcome.err;
    EXPECT_NE(outcome.err.find(text), std::string::npos) << outcome.err;
    EXPECT_EQ(CountOf(outcome.err, "\n"), 1u) << outcome.err;
  };
  expect(with([](auto* o) { o->mesh = "none.obj"; }), 65, "none.obj: no such file");
  expect(with([](auto* o) { o->level = 99, o->picture = "x.svg"; }), 2,
         "--level: 99, allowed: 0 to ");
  expect(with([](auto* o) { o->level = 1; }), 2, "--level: allowed only with");
  expect(with([](auto* o) { o->output = "x.obj"; }), 2, "--output: allowed only with --export");
  expect(with([](auto* o) { o->picture = "x.png"; }), 2, "--picture: x.png, allowed: ");
  const std::string nowhere = folder_ + "/none/x.svg";
  expect(with([&](auto* o) { o->picture = nowhere; }), 74, nowhere + ": cannot be written: ");
}

// Goal:   no output replaces the mesh, under whatever name, nor the other output; a file that
//         cannot be written is reported.
TEST_F(SphereTreeTool, OutputsAreFilesOfTheirOwn) {
  SphereTreeOptions good;
  good.frame = kFrame;
  const std::string text = BumpyObj(2, false);
  good.mesh = File("ball.svg.obj", text);
  good.builder = "octree";
  good.format = "obj";
  fs::create_symlink(good.mesh, folder_ + "/link.obj");
  fs::create_symlink(good.mesh, folder_ + "/link.svg");
  fs::create_hard_link(good.mesh, folder_ + "/hard.obj");
  const auto expect = [&](const std::string& output, const std::string& picture, int status,
                          const std::string& cause) {
    SphereTreeOptions options = good;
    options.output = output;
    options.picture = picture;
    const Outcome outcome = RunTool(options);
    EXPECT_EQ(outcome.status, status) << outcome.err;
    EXPECT_NE(outcome.err.find(cause), std::string::npos) << outcome.err;
    EXPECT_EQ(CountOf(outcome.err, "\n"), cause.empty() ? 0u : 1u) << outcome.err;
    EXPECT_EQ(Contents(good.mesh), text);
  };
  const std::string fresh = folder_ + "/fresh.obj", picture = folder_ + "/new.svg";
  for (const char* same : {"/ball.svg.obj", "/./ball.svg.obj", "/link.obj", "/hard.obj"}) {
    expect(folder_ + same, "", 2, "is the mesh itself");
  }
  expect(fresh, folder_ + "/link.svg", 2, "--picture: " + folder_ + "/link.svg is the mesh itself");
  expect(picture, picture, 2, "is the picture");
  expect(folder_ + "/./new.svg", picture, 2, "is the picture");
  expect(folder_, "", 74, folder_ + ": cannot be written: Is a directory");
  fs::create_directories(folder_ + "/folder.svg");
  expect(fresh, folder_ + "/folder.svg", 74, "folder.svg: cannot be written: Is a directory");
  expect(folder_ + "/none/x.obj", "", 74, "x.obj: cannot be written: No such file or directory");
  expect(good.mesh + "/x.obj", "", 74, "x.obj: cannot be written: Not a directory");
  EXPECT_FALSE(fs::exists(fresh) || fs::exists(picture));
  expect(fresh, picture, 0, "");
  EXPECT_TRUE(fs::exists(fresh) && fs::exists(picture));
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// Goal:   a mesh that does not fit in memory is one line and an exit code, wherever the memory
// ends. Method: a process with little memory, in steps from too little for the file to nearly
// enough.
TEST_F(SphereTreeTool, TooLittleMemoryIsOneLine) {
  SphereTreeOptions options;
  options.frame = kFrame;
  options.mesh = File("ball.obj", BumpyObj(60, false));
  options.builder = "octree";
  for (const rlim_t more : {1, 4, 16, 32}) {
    const auto run = [&] {
      std::size_t pages = 0;
      std::ifstream("/proc/self/statm") >> pages;
      const rlim_t bytes = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + (more << 20);
      const rlimit limit = {bytes, bytes};
      setrlimit(RLIMIT_AS, &limit);
      std::exit(RunSphereTree(options));
    };
    EXPECT_EXIT(run(), testing::ExitedWithCode(65),
                "^collisionctl: [^\n]*not enough memory[^\n]*\n$")
        << more;
  }
}
#endif

// Goal:   standard output is one document, whatever else is requested.
TEST_F(SphereTreeTool, StandardOutputHoldsOneDocument) {
  SphereTreeOptions options;
  options.frame = kFrame;
  options.mesh = File("ball.obj", BumpyObj(3, false));
  options.builder = "octree";
  options.levels = 3;
  EXPECT_NE(RunTool(options).out.find("AT MOST"), std::string::npos);
  options.report = "json";
  options.picture = folder_ + "/ball.svg";
  v1::TreeReport report;
  const std::string out = RunTool(options).out;
  EXPECT_TRUE(out.starts_with("{\"schema\":\"collision/1\",\"kind\":\"sphere-tree\",")) << out;
  EXPECT_EQ(ComplaintsAbout({out.substr(0, out.find('\n'))}), "");
  google::protobuf::util::JsonParseOptions ignore;
  ignore.ignore_unknown_fields = true;
  EXPECT_TRUE(google::protobuf::util::JsonStringToMessage(out, &report, ignore).ok());
  EXPECT_LE(report.levels_size(), 3);
  EXPECT_TRUE(IsWellFormed(Contents(options.picture)));
  options.report.clear();
  options.format = "binpb";
  const std::string exported = RunTool(options).out;
  v1::SphereTree message;
  EXPECT_TRUE(message.ParseFromString(exported) && FromMessage(message));
  options.output = folder_ + "/ball.binpb";
  EXPECT_NE(RunTool(options).out.find("AT MOST"), std::string::npos);
  EXPECT_EQ(Contents(options.output), exported);
}

}  // namespace
}  // namespace collision::client
