#include "cli/program.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <opencv2/core/utils/logger.hpp>

#include "cli/plugins/plugins.h"
#include "cli/verbs.h"
#include "cli/version.h"
#include "core/error.h"
#include "core/nearest.h"
#include "detectors/builtin.h"
#include "trackers/builtin.h"

namespace relock {
namespace {

constexpr int kPartly = 1;  // something that was asked for was not done, the rest was
constexpr int kUserError = 2;

/// The arguments of all verbs, filled in by CLI11.
struct Arguments {
  RunArguments run;
  ScoreArguments score;
  TimelineArguments timeline;
  DetectArguments detect;
  ListArguments list;
  InspectArguments inspect;
  CheckArguments check;
  NewArguments start_new;
  MarkerArguments marker;
  std::vector<std::filesystem::path> plugins;  // of any verb that names methods
};

template <class Text>
CLI::Option* add_gate(CLI::App& verb, Text& gate, const std::string& when) {
  return verb.add_option("--gate", gate,
                         when + ": centre (within 0.25 D) or iou (overlap of boxes at least 0.5)");
}

void add_run(CLI::App& app, RunArguments& a) {
  CLI::App& verb = *app.add_subcommand("run", "Show recordings to methods and write down what they say");
  verb.add_option("plan", a.plan, "a plan file (TOML): sequences x gaps x methods x protocols x seeds");
  verb.add_option("--sequence", a.sequence,
                  "the recording: a path, or one that relock comes with: klahaag (if none is given), "
                  "klahaag-prints");
  verb.add_option("--labels", a.labels, "its labels; else labels.csv in the recording's folder");
  verb.add_option("--rate", a.rate_hz, "nominal rate, Hz; also makes the times of a recording that has none");
  verb.add_option("--format", a.format, "how it is kept on disk; else recognised");
  verb.add_option("--topic", a.topic, "ROS bags: of the pictures; else the only one that has any");
  verb.add_option("--methods", a.methods, "names, separated by commas: kcf,aruco,csrt(psr_threshold=0.05)");
  verb.add_option("--protocol", a.protocol,
                  "once (if none is given), reset (start again after a loss) or detect (no start)");
  verb.add_option("--gaps", a.gaps,
                  "frames lost on the way: none, paper, paper-6s, bernoulli(p), gilbert-elliott(p,r), "
                  "periodic(n,k), trace(file) or fps(n)");
  verb.add_option("--seed", a.seed, "of everything drawn at random; else 1");
  add_gate(verb, a.gate, "protocol reset: when an answer is a Hit");
  verb.add_option("--out", a.out, "folder for the results; else results");
  verb.add_option("--jobs,-j", a.jobs,
                  "runs at a time; the results are the same for any number, their timing is not")
      ->capture_default_str();
  verb.add_option("--frame-limit", a.frame_limit_s,
                  "seconds that a method may take for one frame before it counts as hung; else 60");
  verb.add_option("--memory-limit", a.memory_limit_mb, "MB that a run may allocate; else 4096");
  verb.add_flag("--dry-run", a.dry_run, "list what would be run, and estimate how long it takes");
}

void add_score(CLI::App& app, ScoreArguments& a) {
  CLI::App& verb =
      *app.add_subcommand("score", "Score runs: recognition, availability, losses, recovery, exactness");
  verb.add_option("results", a.folder, "a folder of results, or a part of one")->required();
  verb.add_flag("--json", a.json, "print scores as JSON");
  add_gate(verb, a.gate, "when an answer is a Hit");
}

void add_timeline(CLI::App& app, TimelineArguments& a) {
  CLI::App& verb =
      *app.add_subcommand("timeline", "Show when each method had the target, lost it and had it back");
  verb.add_option("results", a.folder, "a folder of results, or a part of one")->required();
  verb.add_option("--target", a.target, "only this target");
  verb.add_flag("--ascii", a.ascii, "letters only, without colour");
  add_gate(verb, a.gate, "when an answer is a Hit");
}

void add_detect(CLI::App& app, DetectArguments& a) {
  CLI::App& verb = *app.add_subcommand("detect", "Look for targets in single pictures");
  verb.add_option("images", a.images, "pictures")->required();
  verb.add_option("--method", a.method, "a detector, with options: aruco(dictionary=4x4_50)")->required();
  verb.add_flag("--json", a.json, "print one JSON object a picture and line");
  verb.add_option("--draw", a.draw, "write the picture with what was found drawn on it");
}

void add_list(CLI::App& app, ListArguments& a) {
  CLI::App& verb = *app.add_subcommand("list", "Show all methods");
  verb.add_flag("-v,--verbose", a.verbose, "with their options, defaults and units");
  verb.add_flag("--json", a.json, "print them as JSON");
}

void add_inspect(CLI::App& app, InspectArguments& a) {
  CLI::App& verb = *app.add_subcommand(
      "inspect", "Tell what a recording is and what it is fit for: gaps, labels, steps, blur");
  verb.add_option("recording", a.path, "the recording, or the name of one that relock comes with")
      ->required();
  verb.add_option("--labels", a.labels, "its labels; else labels.csv in the recording's folder");
  verb.add_option("--rate", a.rate_hz, "nominal rate, Hz; also makes the times of a recording that has none");
  verb.add_option("--format", a.format, "how it is kept on disk; else recognised");
  verb.add_option("--topic", a.topic, "ROS bags: of the pictures; else the only one that has any");
  verb.add_flag("--no-pictures", a.no_pictures, "do not read the pictures: nothing is said of blur");
  verb.add_flag("--json", a.json, "print everything as JSON, frame by frame");
}

void add_check(CLI::App& app, CheckArguments& a) {
  CLI::App& verb =
      *app.add_subcommand("check", "Check that methods keep what trackers and detectors promise");
  verb.add_option("methods", a.methods, "names, separated by commas");
  verb.add_flag("--all", a.all, "every tracker and detector");
  verb.add_option("--check", a.only, "make only this check");
  verb.add_option("--frames", a.frames, "shown by the check memory")->capture_default_str();
  verb.add_option("--budget", a.budget_s, "most time that the check memory takes, s")->capture_default_str();
  verb.add_option("--silence", a.silence_s, "longest time that one answer may take, s")
      ->capture_default_str();
  verb.add_flag("--json", a.json, "print the results as JSON");
}

void add_new(CLI::App& app, NewArguments& a) {
  CLI::App& verb = *app.add_subcommand("new", "Begin a plug-in of your own");
  verb.add_option("kind", a.kind, "detector or tracker")->required();
  verb.add_option("name", a.name, "its name: lower case letters, digits and _")->required();
  verb.add_option("--in", a.in, "where its folder goes")->capture_default_str();
}

void add_marker(CLI::App& app, MarkerArguments& a) {
  CLI::App& verb = *app.add_subcommand("marker", "Print markers at their true size");
  verb.add_option(
          "markers", a.markers,
          "codes, separated by commas: ring:01,ring(geometry=even):010,aruco6x6_250:23,apriltag36h11:5")
      ->required();
  verb.add_option("--size", a.size, "diameter of a ring, side of a square; in mm, cm, m or in: 150mm")
      ->required();
  verb.add_option("--out,-o", a.out,
                  "the file; .pdf, .svg or .png, of which the last two are one for each page")
      ->required();
  verb.add_option("--paper", a.paper, "a4, a3, letter, or marker: just as large as the marker")
      ->capture_default_str();
  verb.add_option("--dpi", a.dpi, "dots per inch of .png")->capture_default_str();
  verb.add_option("--geometry", a.rings.geometry,
                  "rings: paper, even, or all radii from the innermost on: 0.2-0.4,0.6-0.7,0.8-1")
      ->capture_default_str();
  verb.add_option("--quiet-zone", a.rings.quiet_zone, "rings: black up to this many radii")
      ->capture_default_str();
  verb.add_option("--soft-border", a.rings.soft_border, "rings: width of the passage to white, in radii")
      ->capture_default_str();
  verb.add_flag("--inverted", a.rings.inverted, "rings: black on white");
  verb.add_flag("--no-caption", a.no_caption, "print no code, size and geometry below");
}

/// CLI11 names a verb it does not know, but not the one that was meant.
void check_verb(int argc, char** argv, const CLI::App& app) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> verbs;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    verbs.push_back(verb->get_name());
  if (std::find(verbs.begin(), verbs.end(), argv[1]) == verbs.end())
    throw Error(fmt::format("there is no verb \"{}\"{}; `relock --help` shows all", argv[1],
                            did_you_mean(argv[1], verbs)));
}

/// Gives --plugin to every verb that names methods.
void add_plugin_option(CLI::App& app, std::vector<std::filesystem::path>& plugins) {
  const std::vector<std::string> naming{"run", "detect", "list", "check"};
  for (CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (std::find(naming.begin(), naming.end(), verb->get_name()) == naming.end()) continue;
    verb->add_option("--plugin", plugins,
                     "a shared library that brings methods, or a folder of them; repeatable")
        ->allow_extra_args(false);
  }
}

/// The methods that the verb can name: those of plug-ins too. Tells which plug-ins were left out.
Methods with_plugins(const CLI::App& app, const Arguments& arguments, Methods methods, int& status) {
  const auto verbs = app.get_subcommands();
  if (verbs.empty() || !verbs.front()->get_option_no_throw("--plugin")) return methods;
  for (const LeftOut& plugin : add_plugins(methods, arguments.plugins)) {
    fmt::print(stderr, "relock: plug-in {} is left out: {}\n", plugin.file.string(), plugin.why);
    if (plugin.asked_for) status = kPartly;
  }
  return methods;
}

int dispatch(const CLI::App& app, const Arguments& arguments, const Methods& methods) {
  if (app.got_subcommand("run")) return run(arguments.run, methods);
  if (app.got_subcommand("score")) return score(arguments.score);
  if (app.got_subcommand("timeline")) return timeline(arguments.timeline);
  if (app.got_subcommand("detect")) return detect(arguments.detect, methods);
  if (app.got_subcommand("inspect")) return inspect(arguments.inspect);
  if (app.got_subcommand("check")) return check(arguments.check, methods);
  if (app.got_subcommand("new")) return start_new(arguments.start_new, methods);
  if (app.got_subcommand("marker")) return marker(arguments.marker);
  return list(arguments.list, methods);
}

int complain(std::string_view sentence) {
  fmt::print(stderr, "relock: {}\n", sentence);
  return kUserError;
}

}  // namespace

Methods builtin_methods() {
  Methods methods;
  add_builtin_detectors(methods.detectors);
  add_builtin_trackers(methods.trackers);
  return methods;
}

int run_program(int argc, char** argv, const Methods& methods) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);  // faults are told in our words
  CLI::App app(
      "relock: does a tracker or detector keep the target when the picture blurs and frames go missing?",
      "relock");
  Arguments arguments;
  app.set_version_flag("--version", std::string("relock ") + kVersion);
  app.require_subcommand(1);
  add_run(app, arguments.run);
  add_score(app, arguments.score);
  add_timeline(app, arguments.timeline);
  add_detect(app, arguments.detect);
  add_list(app, arguments.list);
  add_inspect(app, arguments.inspect);
  add_check(app, arguments.check);
  add_new(app, arguments.start_new);
  add_marker(app, arguments.marker);
  add_plugin_option(app, arguments.plugins);
  try {
    check_verb(argc, argv, app);
    app.parse(argc, argv);
    int status = 0;
    const Methods all = with_plugins(app, arguments, methods, status);
    status = std::max(status, dispatch(app, arguments, all));
    if (std::fflush(stdout) != 0) return complain("the output cannot be written; is the disk full?");
    return status;
  } catch (const CLI::Success& wanted) {  // --help, --version
    return app.exit(wanted);
  } catch (const CLI::ParseError& fault) {
    return complain(fmt::format("{}; see `relock --help`", fault.what()));
  } catch (const Error& fault) {
    return complain(fault.what());
  } catch (const std::filesystem::filesystem_error& fault) {
    return complain(fmt::format("{} ({})", fault.path1().string(), fault.code().message()));
  } catch (const std::bad_alloc&) {
    return complain("there is not enough memory");
  } catch (const std::exception& fault) {  // of a library, on input that nobody thought of
    return complain(fault.what());
  }
}

}  // namespace relock
