// What the program can be asked on the command line.

#include "cli/arguments.h"

#include <CLI/CLI.hpp>

namespace relock {
namespace {

template <class Text>
CLI::Option* add_gate(CLI::App& verb, Text& gate, const std::string& when) {
  return verb.add_option("--gate", gate,
                         when + ": centre (within 0.25 D) or iou (overlap of boxes at least 0.5)");
}

void add_jobs(CLI::App& verb, int& jobs, const std::string& what) {
  verb.add_option("--jobs,-j", jobs, what)->check(CLI::Range(1, 256))->capture_default_str();
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
                  "once (if none is given), reset (start again after a loss), vot (likewise, by VOT's "
                  "rules), multistart (from many frames, forward "
                  "and backward) or detect (no start)");
  verb.add_option("--gaps", a.gaps,
                  "frames lost on the way: none, paper, paper-6s, gaps(n,p), bernoulli(p), "
                  "gilbert-elliott(p,r), periodic(n,k), trace(file) or fps(n)");
  verb.add_flag("--paired", a.paired,
                "run as recorded, too, and tell at the end what the gaps cost each method");
  verb.add_option("--seed", a.seed, "of everything drawn at random; else 1");
  add_gate(verb, a.gate, "protocol reset: when an answer is a Hit");
  verb.add_option(
      "--real-time", a.real_time,
      "frames arrive at their capture times, and a method that is busy misses frames: latest (the newest "
      "waits) or queue(n)");
  verb.add_option(
      "--latency", a.latency,
      "real time: what an answer takes; measured (if none is given), constant(20ms), or a file with "
      "columns frame and wall_ms");
  verb.add_option("--out", a.out, "folder for the results; else results");
  add_jobs(verb, a.jobs, "runs at a time; the results are the same for any number, their timing is not");
  verb.add_option("--frame-limit", a.frame_limit_s,
                  "seconds that a method may take for one frame before it counts as hung; else 60");
  verb.add_option("--memory-limit", a.memory_limit_mb, "MB that a run may allocate; else 4096");
  verb.add_flag("--dry-run", a.dry_run, "list what would be run, and estimate how long it takes");
}

void add_score(CLI::App& app, ScoreArguments& a) {
  CLI::App& verb =
      *app.add_subcommand("score", "Score runs: recognition, availability, losses, recovery, exactness");
  verb.add_option("results", a.folders, "folders of results, or parts of them")->required();
  verb.add_option("--by", a.by, "a table for each recording, target, code, blur or gap before the frame");
  add_gate(verb, a.gate, "when an answer is a Hit");
  verb.add_flag("--cost", a.cost,
                "also what methods cost: time of a frame and peak memory, of all targets together");
  CLI::Option_group& format = *verb.add_option_group("format");
  const auto add_format = [&](const std::string& name, ScoreFormat value, const std::string& what) {
    format.add_flag_callback(
        name, [&a, value] { a.format = value; }, what);
  };
  add_format("--json", ScoreFormat::json, "print everything as JSON");
  add_format("--csv", ScoreFormat::csv, "print one row for each score of each method");
  add_format("--markdown", ScoreFormat::markdown, "print the tables in Markdown");
  add_format("--latex", ScoreFormat::latex, "print the tables in LaTeX, with booktabs");
  format.require_option(0, 1);
}

void add_compare(CLI::App& app, CompareArguments& a) {
  CLI::App& verb = *app.add_subcommand("compare", "Tell what changed between two result folders");
  verb.add_option("a", a.a, "the folder before, or a part of one")->required();
  verb.add_option("b", a.b, "the folder after")->required();
  verb.add_option("--pair", a.pairs,
                  "compare only this method of A with that one of B: 'kcf=csrt'; repeatable, else every "
                  "method with itself")
      ->allow_extra_args(false);
  verb.add_option("--fail-if", a.fail_if,
                  "exit with 1 when this holds: [METHOD:] METRIC drops|rises > NUMBER [surely], as in "
                  "'availability drops > 0.02'; repeatable")
      ->allow_extra_args(false);
  add_gate(verb, a.gate, "when an answer is a Hit");
  verb.add_flag("--json", a.json, "print everything as JSON, every loss too");
}

/// The verbs that tell one thing of all results below a folder.
void add_results_verb(CLI::App& app, ResultsArguments& a, const std::string& name, const std::string& what) {
  CLI::App& verb = *app.add_subcommand(name, what);
  verb.add_option("results", a.folder, "a folder of results, or a part of one")->required();
  verb.add_flag("--json", a.json, "print it as JSON");
  add_gate(verb, a.gate, "when an answer is a Hit");
}

void add_gain(CLI::App& app, GainArguments& a) {
  CLI::App& verb = *app.add_subcommand(
      "gain", "Tell what combinations gain over the tracker in them, from runs made with --paired");
  verb.add_option("results", a.folder, "a folder of results, or a part of one")->required();
  verb.add_option("--score", a.score, "locked-share, recognition, availability or losses")
      ->capture_default_str();
  add_gate(verb, a.gate, "when an answer is a Hit; else the one by which resets were judged, else centre");
  verb.add_flag("--json", a.json, "print all scores as JSON");
}

void add_explain(CLI::App& app, ExplainArguments& a) {
  CLI::App& verb = *app.add_subcommand(
      "explain", "Tell every loss in order: when, over which gap, in which picture, how it ended");
  verb.add_option("run", a.folder, "the folder of a run, or one of many (yardsticks are then left out)")
      ->required();
  verb.add_option("--target", a.target, "only this target");
  verb.add_flag("--json", a.json, "print it as JSON");
  add_gate(verb, a.gate, "when an answer is a Hit");
}

void add_timeline(CLI::App& app, TimelineArguments& a) {
  CLI::App& verb =
      *app.add_subcommand("timeline", "Show when each method had the target, lost it and had it back");
  verb.add_option("results", a.folder, "a folder of results, or a part of one")->required();
  verb.add_option("--target", a.target, "only this target");
  verb.add_option("--method", a.methods, "only this method; repeatable")->allow_extra_args(false);
  verb.add_flag("--ascii", a.ascii, "letters only, without colour");
  verb.add_option("--svg", a.svg, "draw a figure for a paper into this file in place of letters");
  verb.add_option("--pdf", a.pdf, "likewise, with its fonts in it");
  verb.add_option("--png", a.png, "likewise, at 200 dots per inch");
  verb.add_option("--width-mm", a.width_mm, "of the figure; else 174, two columns of a journal (one is 85)")
      ->check(CLI::Range(40, 2000));
  verb.add_option("--height-mm", a.height_mm, "of the figure; else what its lanes need")
      ->check(CLI::Range(10, 2000));
  add_gate(verb, a.gate, "when an answer is a Hit");
}

void add_video(CLI::App& app, VideoArguments& a) {
  CLI::App& verb = *app.add_subcommand(
      "video", "Draw truth and answers on the recording, methods side by side, at its own times");
  verb.add_option("results", a.folder, "a folder of results of one recording, or a part of one")->required();
  verb.add_option("--out,-o", a.out, "the video's file (.mp4); it must not be there yet")->required();
  verb.add_option("--method", a.methods, "only this method; repeatable, else all but yardsticks")
      ->allow_extra_args(false);
  verb.add_option("--target", a.target, "only this target");
  verb.add_option("--from", a.from_s, "begin here, s from the first frame");
  verb.add_option("--to", a.to_s, "end here, s from the first frame");
  verb.add_option("--sequence", a.sequence,
                  "the recording; else the one of that name that relock comes with");
  verb.add_option("--labels", a.labels, "its labels, where `relock run` was told");
  verb.add_option("--rate", a.rate_hz, "its rate, Hz, likewise");
  verb.add_option("--format", a.format, "how it is kept on disk; else recognised");
  verb.add_option("--topic", a.topic, "ROS bags: of the pictures; else the only one that has any");
  add_gate(verb, a.gate, "when an answer is a Hit");
}

void add_report(CLI::App& app, ReportArguments& a) {
  CLI::App& verb = *app.add_subcommand(
      "report",
      "Write all that results tell into one page: answer, timelines, reasons, losses with pictures");
  verb.add_option("results", a.folder, "a folder of results, or a part of one")->required();
  verb.add_option("--out,-o", a.out, "the page")->capture_default_str();
  verb.add_option("--sequence", a.sequences,
                  "where a recording is now, for its pictures; repeatable, else where it was")
      ->allow_extra_args(false);
  verb.add_option("--pictures-mb", a.pictures_mb, "most that all pictures take in the page, MB; 0: none")
      ->check(CLI::Range(0., 1000.))
      ->capture_default_str();
  add_gate(verb, a.gate, "when an answer is a Hit");
}

void add_detect(CLI::App& app, DetectArguments& a) {
  CLI::App& verb = *app.add_subcommand("detect", "Look for targets in single pictures");
  verb.add_option("images", a.images, "pictures")->required();
  verb.add_option("--method", a.method, "a detector, with options: aruco(dictionary=4x4_50)")->required();
  verb.add_flag("--json", a.json, "print one JSON object a picture and line");
  verb.add_option("--draw", a.draw, "write the picture with what was found drawn on it");
  CLI::Option* explain =
      verb.add_flag("--explain", a.explain, "show the stages of the detector's work: pictures and charts");
  verb.add_option("--out", a.out, "folder for the stages")->capture_default_str()->needs(explain);
  CLI::Option* pose = verb.add_flag("--pose", a.pose, "tell where markers are and how they are tilted, too");
  verb.add_option("--camera", a.camera, "calibration: YAML of OpenCV's or ROS's camera_info")->needs(pose);
  verb.add_option("--size", a.size_m, "of every marker, metres: a ring's diameter, a square's side")
      ->needs(pose);
  verb.add_option("--layout", a.layout, "markers that hang on one plate (TOML)")->needs(pose);
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

void add_simulate(CLI::App& app, SimulateArguments& a) {
  CLI::App& verb = *app.add_subcommand("simulate", "Make a flight whose every frame knows the truth");
  verb.add_option("plan", a.plan, "a plan file (TOML) that states what differs from its preset");
  verb.add_option("--preset", a.preset, "what to fly; --list names all; else ardrone");
  verb.add_option("--target", a.targets, "a target as `relock marker` takes it, 150 mm large; repeatable")
      ->allow_extra_args(false);
  verb.add_option("--seed", a.seed, "of everything drawn at random; else 1");
  verb.add_option("--duration", a.duration_s, "of the flight, s; else 10");
  verb.add_option("--gaps", a.gaps, "frames that are not recorded: a pattern as of `relock run`");
  verb.add_option("--out", a.out, "the recording's folder; it must not be there yet");
  verb.add_option("--preview", a.preview, "write a video of it, too (.mp4)");
  add_jobs(verb, a.jobs, "frames made at a time; the bytes are the same for any number");
  verb.add_flag("--list", a.list, "name the presets");
  verb.add_flag("--show", a.show, "print the whole plan and make nothing");
}

void add_map(CLI::App& app, MapArguments& a) {
  CLI::App& verb = *app.add_subcommand("map", "Map where tracking beats detection, over blur and gaps");
  verb.add_option("--axes", a.axes, "gap,blur, rate,blur or size,blur")->capture_default_str();
  verb.add_option("--across", a.columns,
                  "the columns: lengths of gaps in slots (a gap of 1 is none), rates in Hz or sizes in px")
      ->delimiter(',');
  verb.add_option("--exposures", a.exposures_ms, "the rows: exposure times in ms, which make the blur")
      ->delimiter(',');
  verb.add_option("--gap-share", a.gap_share, "of the intervals, how many are gaps; else 0.05");
  verb.add_option("--seeds", a.seeds, "flights of each cell; else 5");
  verb.add_option("--duration", a.duration_s, "of a flight, s, 0.5 or more; else 5");
  verb.add_option("--flight", a.flight, "a flight plan (TOML) in place of the map's own");
  verb.add_option("--target", a.target, "its target, as `relock marker` takes it; else apriltag36h11:0");
  verb.add_option("--methods", a.methods, "trackers and detectors, separated by commas")
      ->capture_default_str();
  verb.add_option("--tracker", a.tracker, "which tracker is compared; else the best over the map");
  verb.add_option("--detector", a.detector, "which detector is compared; else the best over the map");
  verb.add_option("--out", a.out, "the map's folder; what is there already is not made again")
      ->capture_default_str();
  add_jobs(verb, a.jobs, "flights and runs at a time; the map is the same for any number");
  verb.add_flag("--quick", a.quick, "a small map for a first look");
  verb.add_flag("--dry-run", a.dry_run, "say what would be made, and about how long it takes");
}

void add_jump(CLI::App& app, JumpArguments& a) {
  CLI::App& verb = *app.add_subcommand("jump", "How far a target may jump over a gap before methods lose it");
  verb.add_option("methods", a.methods, "names, separated by commas")->required();
  verb.add_option("--sequence", a.sequence, "a recording; else flights are simulated");
  verb.add_option("--labels", a.labels, "its labels; else labels.csv in the recording's folder");
  verb.add_option("--flight", a.flight, "a flight plan (TOML) in place of the verb's own");
  verb.add_option("--target", a.target, "its target, as `relock marker` takes it; else apriltag36h11:0");
  verb.add_option("--exposure", a.exposure_ms, "exposure time of the flights in ms, which makes the blur");
  verb.add_option("--seeds", a.seeds, "how many flights")->check(CLI::Range(1, 1000))->capture_default_str();
  verb.add_option("--before", a.before,
                  "frames from the start to the gap; 0: the gap follows the start at once")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  verb.add_flag("--no-time-gap", a.no_time_gap, "the same jumps, but the clock as if no frame were missing");
  verb.add_option("--out", a.out, "folder of the flights; what is there already is not flown again")
      ->capture_default_str();
  verb.add_option("--plot", a.plot, "draw the curve into this file: .svg, .pdf or .png");
  add_jobs(verb, a.jobs, "flights and methods at a time; the curve is the same for any number");
  verb.add_flag("--json", a.json, "print the curve as JSON");
}

void add_bench(CLI::App& app, BenchArguments& a) {
  CLI::App& verb =
      *app.add_subcommand("bench", "Measure relock's own detector against what it is meant to reach");
  verb.add_option("what", a.what, "what is measured: ring")->required()->check(CLI::IsMember({"ring"}));
  verb.add_option("--method", a.method, "another detector of rings, or with other options")
      ->capture_default_str();
  CLI::Option* only =
      verb.add_option("--only", a.only, "rows, separated by commas: clutter,tilt; else all")->delimiter(',');
  verb.add_flag("--geometries", a.geometries, "compare rings of other widths and quiet zones instead")
      ->excludes(only);
  verb.add_option("--pictures", a.pictures, "so many of every kind, in place of --full's or a sample's")
      ->check(CLI::Range(1, 1000000));
  verb.add_flag("--full", a.full, "as many pictures as it takes to tell: an hour of one core");
  verb.add_flag("--even-seeds", a.even_seeds, "pictures to tune on: they tell nothing of how good it is");
  add_jobs(verb, a.jobs, "pictures at a time; all but times is the same for any number");
  verb.add_flag("--json", a.json, "print the lines as JSON");
}

void add_reproduce(CLI::App& app, ReproduceArguments& a) {
  CLI::App& verb = *app.add_subcommand(
      "reproduce", "Run the experiments of the paper that the rings come from, its figures beside ours");
  verb.add_flag("--quick", a.quick, "a first look: few conditions, marked QUICK in every figure");
  verb.add_option("--out", a.out,
                  "the folder; what is there already is not made again; else reproduction, or "
                  "reproduction-quick");
  add_jobs(verb, a.jobs, "pictures at a time; the figures are the same for any number");
  verb.add_option("--only", a.only, "experiments, separated by commas: figure-11,table-1; else all")
      ->delimiter(',');
  verb.add_flag("--json", a.json, "print all figures as JSON");
}

void add_realism(CLI::App& app, RealismArguments& a) {
  CLI::App& verb = *app.add_subcommand("realism", "Compare a simulated flight with real footage, in numbers");
  verb.add_option("simulated", a.simulated, "the flight")->required();
  verb.add_option("real", a.real, "a recording, or the name of one that relock comes with; else klahaag");
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

void add_export(CLI::App& app, ExportArguments& a) {
  CLI::App& verb = *app.add_subcommand("export", "Write runs as the result files of other toolkits");
  verb.add_option("results", a.folder, "a folder of results, or a part of one")->required();
  verb.add_option("--as", a.as, "vot, otb, got10k or tum (which evo reads)")->required();
  verb.add_option("--out", a.out, "the files' folder; it must be empty or not there yet")->required();
}

void add_import(CLI::App& app, ImportArguments& a) {
  CLI::App& verb = *app.add_subcommand("import", "Make a run of result files that another toolkit wrote");
  verb.add_option("files", a.files, "result files, one for each target")->required();
  verb.add_option("--as", a.as, "vot, otb or got10k")->required();
  verb.add_option("--sequence", a.sequence, "the recording, or the name of one that relock comes with")
      ->required();
  verb.add_option("--method", a.method, "what to call the method")->required();
  verb.add_option("--target", a.targets, "which target a file is of; repeatable, else all in their order")
      ->allow_extra_args(false);
  verb.add_option("--labels", a.labels, "its labels; else labels.csv in the recording's folder");
  verb.add_option("--rate", a.rate_hz, "nominal rate, Hz; also makes the times of a recording that has none");
  verb.add_option("--format", a.format, "how the recording is kept on disk; else recognised");
  verb.add_option("--out", a.out, "folder for the results")->capture_default_str();
}

void add_compatibility(CLI::App& app, CompatibilityArguments& a) {
  CLI::App& verb =
      *app.add_subcommand("compatibility", "Score runs as the toolkits of VOT, OTB, GOT-10k and evo do");
  verb.add_option("results", a.folder, "a folder of results, or a part of one")->required();
  verb.add_option("--align", a.align, "evo: lay paths over each other first: none, rigid or similarity")
      ->capture_default_str();
  verb.add_option(
          "--eao", a.eao_range,
          "VOT: shortest and longest run of the expected average overlap; else 100 356, multi-start 115 755")
      ->expected(2);
  verb.add_flag("--json", a.json, "print scores and curves as JSON");
}

void add_label(CLI::App& app, LabelArguments& a) {
  CLI::App& verb = *app.add_subcommand("label", "Label a recording by hand, in the browser");
  verb.add_option("recording", a.recording, "the recording, or the name of one that relock comes with")
      ->required();
  verb.add_option("--labels", a.labels, "the file to write; else where the recording's labels belong");
  verb.add_option(
      "--max-gap", a.max_gap_s,
      "between placed key frames, s: over more, nothing is filled in; else what the key frames say, or 2");
  verb.add_option("--sigma", a.sigma_px, "how exactly a hand places, px of the screen")
      ->capture_default_str();
  verb.add_option("--detector", a.detector, "a detector whose answers may be taken over, one by one");
  verb.add_option("--rate", a.rate_hz, "nominal rate, Hz; also makes the times of a recording that has none");
  verb.add_option("--format", a.format, "how the recording is kept on disk; else recognised");
  verb.add_option("--topic", a.topic, "ROS bags: of the pictures; else the only one that has any");
  verb.add_option("--port", a.port, "on this machine; else any that is free");
  verb.add_flag("--check", a.check,
                "tell how good the labels are by leaving key frames out, draw them on a sheet, and end");
  verb.add_option("--sheet", a.sheet, "where --check draws them")->capture_default_str();
  verb.add_flag("--no-browser", a.no_browser, "only print the link");
}

}  // namespace

void add_verbs(CLI::App& app, Arguments& arguments) {
  add_run(app, arguments.run);
  add_score(app, arguments.score);
  add_compare(app, arguments.compare);
  add_results_verb(app, arguments.cost, "cost",
                   "Tell what the gaps cost each method, from runs made with --paired");
  add_gain(app, arguments.gain);
  add_explain(app, arguments.explain);
  add_timeline(app, arguments.timeline);
  add_video(app, arguments.video);
  add_results_verb(app, arguments.survival, "survival",
                   "Tell how long methods hold a target that they were given");
  add_results_verb(app, arguments.attribute, "attribute",
                   "Tell what losses go with: gaps, blur, displacement");
  add_report(app, arguments.report);
  add_detect(app, arguments.detect);
  add_list(app, arguments.list);
  add_inspect(app, arguments.inspect);
  add_check(app, arguments.check);
  add_new(app, arguments.start_new);
  add_simulate(app, arguments.simulate);
  add_map(app, arguments.map);
  add_jump(app, arguments.jump);
  add_bench(app, arguments.bench);
  add_reproduce(app, arguments.reproduce);
  add_realism(app, arguments.realism);
  add_marker(app, arguments.marker);
  add_export(app, arguments.export_results);
  add_import(app, arguments.import_results);
  add_compatibility(app, arguments.compatibility);
  add_label(app, arguments.label);
}

}  // namespace relock
