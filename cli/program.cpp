#include "cli/program.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <opencv2/core/utils/logger.hpp>

#include "cli/verbs.h"
#include "cli/version.h"
#include "core/error.h"
#include "core/nearest.h"
#include "detectors/builtin.h"
#include "trackers/builtin.h"

namespace relock {
namespace {

constexpr int kUserError = 2;

/// The arguments of all verbs, filled in by CLI11.
struct Arguments {
  RunArguments run;
  ScoreArguments score;
  TimelineArguments timeline;
  DetectArguments detect;
  ListArguments list;
  InspectArguments inspect;
};

template <class Text>
CLI::Option* add_gate(CLI::App& verb, Text& gate, const std::string& when) {
  return verb.add_option("--gate", gate,
                         when + ": centre (within 0.25 D) or iou (overlap of boxes at least 0.5)");
}

void add_run(CLI::App& app, RunArguments& a) {
  CLI::App& verb = *app.add_subcommand("run", "Show a recording to methods and write down what they say");
  verb.add_option(
          "--sequence", a.sequence,
          "the recording: a folder of pictures, or one that relock comes with (klahaag, klahaag-prints)")
      ->capture_default_str();
  verb.add_option("--labels", a.labels, "its labels; else labels.csv in the recording's folder");
  verb.add_option("--rate", a.rate_hz, "nominal rate, Hz; also makes the times of a recording that has none");
  verb.add_option("--format", a.format, "how it is kept on disk; else recognised");
  verb.add_option("--topic", a.topic, "ROS bags: of the pictures; else the only one that has any");
  verb.add_option("--methods", a.methods, "names, separated by commas: kcf,aruco,csrt(psr_threshold=0.05)")
      ->required();
  verb.add_option("--protocol", a.protocol, "once, reset (start again after a loss) or detect (no start)")
      ->capture_default_str();
  verb.add_option("--gaps", a.gaps,
                  "frames lost on the way: none, paper, paper-6s, bernoulli(p), gilbert-elliott(p,r), "
                  "periodic(n,k), trace(file) or fps(n)")
      ->capture_default_str();
  verb.add_option("--seed", a.seed, "of everything drawn at random")->capture_default_str();
  add_gate(verb, a.gate, "protocol reset: when an answer is a Hit")->capture_default_str();
  verb.add_option("--out", a.out, "folder for the results")->capture_default_str();
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

int dispatch(const CLI::App& app, const Arguments& arguments, const Methods& methods) {
  if (app.got_subcommand("run")) return run(arguments.run, methods);
  if (app.got_subcommand("score")) return score(arguments.score);
  if (app.got_subcommand("timeline")) return timeline(arguments.timeline);
  if (app.got_subcommand("detect")) return detect(arguments.detect, methods);
  if (app.got_subcommand("inspect")) return inspect(arguments.inspect);
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
  try {
    check_verb(argc, argv, app);
    app.parse(argc, argv);
    const int status = dispatch(app, arguments, methods);
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
