#include "cli/program.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <opencv2/core/utils/logger.hpp>

#include "cli/arguments.h"
#include "cli/plugins/plugins.h"
#include "cli/version.h"
#include "core/error.h"
#include "core/nearest.h"
#include "detectors/builtin.h"
#include "trackers/builtin.h"

namespace relock {
namespace {

constexpr int kPartly = 1;  // something that was asked for was not done, the rest was
constexpr int kUserError = 2;

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
  const std::vector<std::string> naming{"run", "detect", "list", "check", "map", "jump", "bench", "label"};
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
  if (app.got_subcommand("compare")) return compare(arguments.compare);
  if (app.got_subcommand("cost")) return cost(arguments.cost);
  if (app.got_subcommand("gain")) return gain(arguments.gain);
  if (app.got_subcommand("explain")) return explain(arguments.explain);
  if (app.got_subcommand("timeline")) return timeline(arguments.timeline);
  if (app.got_subcommand("video")) return video(arguments.video);
  if (app.got_subcommand("survival")) return survival(arguments.survival);
  if (app.got_subcommand("attribute")) return attribute(arguments.attribute);
  if (app.got_subcommand("report")) return report(arguments.report);
  if (app.got_subcommand("detect")) return detect(arguments.detect, methods);
  if (app.got_subcommand("inspect")) return inspect(arguments.inspect);
  if (app.got_subcommand("check")) return check(arguments.check, methods);
  if (app.got_subcommand("simulate")) return simulate(arguments.simulate);
  if (app.got_subcommand("map")) return map(arguments.map, methods);
  if (app.got_subcommand("jump")) return jump(arguments.jump, methods);
  if (app.got_subcommand("bench")) return bench_detector(arguments.bench, methods);
  if (app.got_subcommand("reproduce")) return reproduce(arguments.reproduce, methods);
  if (app.got_subcommand("realism")) return realism(arguments.realism);
  if (app.got_subcommand("new")) return start_new(arguments.start_new, methods);
  if (app.got_subcommand("marker")) return marker(arguments.marker);
  if (app.got_subcommand("export")) return export_results(arguments.export_results);
  if (app.got_subcommand("import")) return import_results(arguments.import_results);
  if (app.got_subcommand("label")) return label(arguments.label, methods);
  if (app.got_subcommand("compatibility")) return compatibility(arguments.compatibility);
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
  add_verbs(app, arguments);
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
