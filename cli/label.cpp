// `relock label`: truth for one's own recording, placed by hand in a browser.

#include <fmt/format.h>
#include <spawn.h>
#include <unistd.h>

#include "cli/catalogue.h"
#include "cli/drawing.h"
#include "cli/labelling/check_sheet.h"
#include "cli/labelling/server.h"
#include "cli/recordings.h"
#include "cli/verbs.h"
#include "core/error.h"

extern char** environ;

namespace relock {
namespace {

Sequence open_for_labelling(const LabelArguments& a) {
  OpenOptions options{a.labels, a.rate_hz, {}, a.format, a.topic};
  options.truth = Truth::ignored;
  return open_sequence(recording_path(a.recording), options);
}

std::unique_ptr<Helper> helper_of(const std::optional<std::string>& asked, const Methods& methods) {
  if (!asked) return nullptr;
  const auto specs = parse_methods(*asked);
  if (specs.size() != 1) throw Error("--detector takes one method");
  const DetectorEntry& entry = detector_entry(methods, specs[0].name);
  choose(methods, specs[0]);  // checks the options
  const Options options(entry.name, entry.options, specs[0].options);
  return std::make_unique<Helper>(Helper{specs[0].name, entry.make(options, 1)});
}

/// Where somebody sits before a screen, their browser shows the page; whether it can is its own business.
void show_in_browser(const std::string& link) {
  const bool screen = std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
  if (!screen || isatty(STDOUT_FILENO) == 0) return;
  std::string program = "xdg-open", address = link;
  char* arguments[] = {program.data(), address.data(), nullptr};
  pid_t child = 0;
  posix_spawnp(&child, "xdg-open", nullptr, nullptr, arguments, environ);
}

/// Tells how good the labels are, and shows them.
void check(const LabelDesk& desk, const std::filesystem::path& sheet) {
  const auto checks = check_labels(desk);
  fmt::print("{}", check_text(desk, checks));
  write_picture(sheet, contact_sheet(desk, checks));
  fmt::print("The pictures are in {}\n", sheet.string());
}

}  // namespace

int label(const LabelArguments& arguments, const Methods& methods) {
  if (arguments.max_gap_s && !(*arguments.max_gap_s > 0)) throw Error("--max-gap must be above 0");
  if (!(arguments.sigma_px >= 0.01 && arguments.sigma_px <= 100))
    throw Error("--sigma must be from 0.01 to 100 px");
  LabelDesk desk(open_for_labelling(arguments), arguments.max_gap_s);
  if (arguments.check) {
    check(desk, arguments.sheet);
    return 0;
  }
  LabelServer server(desk, helper_of(arguments.detector, methods), {arguments.port, arguments.sigma_px});
  fmt::print("Label {} here, on this machine only: {}\n", desk.sequence().recording.name, server.link());
  fmt::print("Everything is saved at once, in {} and {}; end with Ctrl-C\n", desk.labels_file().string(),
             desk.keys_file().filename().string());
  std::fflush(stdout);
  if (!arguments.no_browser) show_in_browser(server.link());
  server.serve();
  return 0;
}

}  // namespace relock
