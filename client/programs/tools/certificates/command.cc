#include "client/programs/tools/certificates/command.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>

#include "client/programs/shared/command_line.h"
#include "client/programs/shared/exit_code.h"
#include "client/programs/tools/certificates/authority.h"
#include "idl/credentials/files.h"
#include "idl/credentials/validity.h"

namespace collision::client {
namespace {

constexpr std::int64_t kDay = 86400;
constexpr std::int64_t kDaysMax = 3650;

constexpr const char* kFooter = R"(
Examples (keep DIR/authority where no program of the world runs):
  collisionctl --world lab make-certificates DIR --service --simulator alpha --simulator beta
  collisionctl make-certificates DIR --simulator gamma        one more, of the same world
  collisionctl make-certificates DIR --monitor desk --operator night-shift --days 30
  collisiond --world lab --credentials DIR/service            or COLLISION_CREDENTIALS=DIR/service

A simulator may write as itself alone, a monitor may read and watch, an operator may do that and
give commands. What is there is never written over: to renew credentials, move their folder away.
Exit codes: 0 done, 2 usage, 74 a file cannot be read or written, or libcrypto is missing.)";

/// What is wrong with the command line.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

std::vector<Bearer> BearersOf(const CertificateOptions& options) {
  std::vector<Bearer> bearers;
  if (options.service) bearers.push_back({DdsRole::kService, "service"});
  for (const auto& name : options.simulators)
    bearers.push_back({DdsRole::kSimulator, name, options.monitoring});
  for (const auto& name : options.monitors) bearers.push_back({DdsRole::kMonitor, name});
  for (const auto& name : options.operators) bearers.push_back({DdsRole::kOperator, name});
  return bearers;
}

std::int64_t Now() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::seconds>(now).count();
}

/// The authority in the folder, or a new one. Throws UsageError if the one that is there is of
/// another world.
Authority AuthorityFor(const CertificateOptions& options, const CertificatePlace& place) {
  const std::optional<Authority> there = Authority::Open(options.folder);
  if (!there) {
    const SecuredWorld world{place.world.value_or("default"), place.domain.value_or(0),
                             ProtectionOf(options.protection).value_or(dds::Protection::kSign)};
    const Authority made = Authority::Make(options.folder, world, Now());
    std::cout << "world \"" << world.world << "\", DDS domain " << world.domain
              << ": new authority in " << options.folder << "/authority\n";
    return made;
  }
  const SecuredWorld& world = there->world();
  if (place.world.value_or(world.world) != world.world ||
      place.domain.value_or(world.domain) != world.domain) {
    throw UsageError(
        options.folder + " is of world \"" + world.world + "\" on DDS domain " +
        std::to_string(world.domain) +
        ": for another one (--world, --domain, COLLISION_WORLD, COLLISION_DOMAIN) take "
        "another folder");
  }
  if (!options.protection.empty() && options.protection != NameOf(world.protection)) {
    throw UsageError(options.folder + " has the protection " + NameOf(world.protection) +
                     ", which all programs of a world share: for another one take another folder");
  }
  return *there;
}

void RefuseWhatIsThere(const std::string& of_authority, const std::vector<Bearer>& bearers) {
  std::vector<std::string> folders;
  for (const Bearer& bearer : bearers) {
    const std::string folder = Authority::FolderOf(of_authority, bearer);
    if (std::filesystem::exists(folder)) {
      throw SigningError(folder +
                         ": is there already, and is not written over: move it away to "
                         "make new ones; nothing was made");
    }
    if (std::count(folders.begin(), folders.end(), folder) > 0) {
      throw UsageError("\"" + bearer.name + "\" is named twice");
    }
    folders.push_back(folder);
  }
}

std::string HostOf(const Bearer& bearer) {
  switch (bearer.role) {
    case DdsRole::kService:
      return "each host of the service, also of a standby";
    case DdsRole::kSimulator:
      return "the host of simulator \"" + bearer.name + "\"";
    default:
      return "the host of " + bearer.name;
  }
}

void Make(const CertificateOptions& options, const CertificatePlace& place) {
  const std::vector<Bearer> bearers = BearersOf(options);
  if (bearers.empty()) {
    throw UsageError("nothing to make: --service, --simulator, --monitor or --operator");
  }
  RefuseWhatIsThere(options.folder, bearers);
  const Authority authority = AuthorityFor(options, place);
  const std::int64_t now = Now();
  const Period period{now - kBeforehand, now + options.days * kDay};
  for (const Bearer& bearer : bearers) {
    std::cout << authority.Issue(bearer, period) << ": copy it to " << HostOf(bearer) << '\n';
  }
  std::cout << "until " << credentials::DateText(period.end) << " at the latest; there, "
            << credentials::kVariable
            << " (or --credentials) names the folder, readable by the program alone\n";
}

}  // namespace

CertificatePlace GivenPlace(const CLI::App& app) {
  CertificatePlace place;
  if (app.count("--world") > 0) place.world = app["--world"]->as<std::string>();
  if (app.count("--domain") > 0) place.domain = app["--domain"]->as<std::uint32_t>();
  return place;
}

CLI::App* AddCertificatesCommand(CLI::App* app, CertificateOptions* options) {
  CLI::App* command = app->add_subcommand(
      "make-certificates", "Credentials for the programs of a secured world (DDS Security)");
  command
      ->add_option("DIR", options->folder,
                   "Folder of the authority, made if it is missing, and of what it makes")
      ->required();
  command->add_flag("--service", options->service, "For collisiond");
  const auto add = [command](const char* name, std::vector<std::string>* names, const char* text) {
    command->add_option(name, *names, text)->check(IdentifierWord())->allow_extra_args(false);
  };
  add("--simulator", &options->simulators, "For the simulator of this name; may be repeated");
  command
      ->add_flag("--monitoring", options->monitoring,
                 "These simulators may also monitor, in the same program: a process has one set of "
                 "credentials")
      ->needs("--simulator");
  add("--monitor", &options->monitors, "For someone who looks; may be repeated");
  add("--operator", &options->operators, "For someone who looks and commands; may be repeated");
  command->add_option("--days", options->days, "How long they hold, 1 to 3650")
      ->check(WholeBetween(1, kDaysMax))
      ->capture_default_str();
  command
      ->add_option("--protection", options->protection,
                   "Of a new authority, what each packet carries: sign, sign-for-each-reader or "
                   "encrypt (docker/SECURITY.md); default: sign")
      ->check(OneOf({"sign", "sign-for-each-reader", "encrypt"}));
  command->footer(kFooter);
  return command;
}

int RunMakeCertificates(const CertificateOptions& options, const CertificatePlace& place) {
  const auto fail = [](const std::exception& error, int code) {
    std::cerr << "collisionctl: make-certificates: " << error.what() << '\n';
    return code;
  };
  try {
    Make(options, place);
    return kExitOk;
  } catch (const UsageError& error) {
    return fail(error, kExitUsage);
  } catch (const SigningError& error) {
    return fail(error, kExitOutputFailed);
  }
}

}  // namespace collision::client
