#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/print/design.h"
#include "cli/program.h"

// One function for each verb of the program, in a file of its own. Each returns the exit status.

namespace relock {

/// What is not given has the plan's defaults (cli/runs/plan.h).
struct RunArguments {
  std::optional<std::filesystem::path> plan;  ///< a plan file, in place of all but the last five
  std::optional<std::filesystem::path>
      sequence;  ///< a path, or the name of a recording that relock comes with
  std::optional<std::filesystem::path> labels;
  std::optional<double> rate_hz;
  std::optional<std::string> format;  ///< else recognised
  std::optional<std::string> topic;   ///< ROS bags
  std::optional<std::string> methods;
  std::optional<std::string> protocol;
  std::optional<std::string> gaps;
  std::optional<std::uint64_t> seed;
  std::optional<std::string> gate;
  std::optional<std::string> real_time;
  std::optional<std::string> latency;
  std::optional<std::filesystem::path> out;
  std::optional<double> frame_limit_s;
  std::optional<double> memory_limit_mb;
  int jobs = 1;
  bool dry_run = false;
  bool paired = false;  ///< as recorded, too, and the cost of the gaps at the end
};
int run(const RunArguments& arguments, const Methods& methods);

enum class ScoreFormat : std::uint8_t { text, json, csv, markdown, latex };
struct ScoreArguments {
  std::vector<std::filesystem::path> folders;
  std::optional<std::string> gate;  ///< else the one by which resets were judged, else centre
  std::optional<std::string> by;    ///< a table for each recording, target, code, bin of blur or of gap
  bool cost = false;                ///< also what methods cost: not the same from run to run
  ScoreFormat format = ScoreFormat::text;
};
int score(const ScoreArguments& arguments);

/// Of the verbs that tell one thing of all results below a folder.
struct ResultsArguments {
  std::filesystem::path folder;
  std::optional<std::string> gate;  ///< else the one by which resets were judged, else centre
  bool json = false;
};
int cost(const ResultsArguments& arguments);
int survival(const ResultsArguments& arguments);
int attribute(const ResultsArguments& arguments);

struct GainArguments {
  std::filesystem::path folder;
  std::optional<std::string> gate;     ///< else the one by which resets were judged, else centre
  std::string score = "locked-share";  ///< of which the table tells
  bool json = false;                   ///< tells of all
};
int gain(const GainArguments& arguments);

struct CompareArguments {
  std::filesystem::path a, b;      ///< before and after
  std::vector<std::string> pairs;  ///< "kcf=csrt": only these methods, of A and of B; else those of one name
  std::vector<std::string> fail_if;  ///< conditions (cli/compare/fail_if.h)
  std::optional<std::string> gate;   ///< else the one by which resets were judged, else centre
  bool json = false;
};
/// 1 when a condition holds, 2 when one cannot be told.
int compare(const CompareArguments& arguments);

struct ExplainArguments {
  std::filesystem::path folder;
  std::optional<std::string> gate;    ///< else the one by which resets were judged, else centre
  std::optional<std::string> target;  ///< only this one
  bool json = false;
};
int explain(const ExplainArguments& arguments);

struct TimelineArguments {
  std::filesystem::path folder;
  std::optional<std::string> gate;    ///< else the one by which resets were judged, else centre
  std::optional<std::string> target;  ///< only this one
  bool ascii = false;
  std::vector<std::string> methods;                    ///< else all; of figures all but yardsticks
  std::optional<std::filesystem::path> svg, png, pdf;  ///< figures in place of letters
  std::optional<double> width_mm, height_mm;  ///< of figures; else a journal's column, and what lanes need
};
int timeline(const TimelineArguments& arguments);

struct ReportArguments {
  std::filesystem::path folder;
  std::filesystem::path out = "report.html";
  std::optional<std::string> gate;  ///< else the one by which resets were judged, else centre
  std::vector<std::filesystem::path>
      sequences;           ///< recordings that are not where they were, for their pictures
  double pictures_mb = 4;  ///< all pictures together, as they stand in the page
};
int report(const ReportArguments& arguments);

struct VideoArguments {
  std::filesystem::path folder;
  std::filesystem::path out;
  std::optional<std::filesystem::path> sequence;  ///< the recording; else one that relock comes with
  std::optional<std::filesystem::path> labels;
  std::optional<double> rate_hz;
  std::optional<std::string> format;   ///< else recognised
  std::optional<std::string> topic;    ///< ROS bags
  std::vector<std::string> methods;    ///< else all but yardsticks
  std::optional<std::string> gate;     ///< else the one by which resets were judged, else centre
  std::optional<std::string> target;   ///< only this one
  std::optional<double> from_s, to_s;  ///< only this part
};
int video(const VideoArguments& arguments);

struct DetectArguments {
  std::vector<std::filesystem::path> images;
  std::string method;
  bool json = false;
  std::optional<std::filesystem::path> draw = {};
  bool explain = false;                     ///< show the stages of the detector's work, too
  std::filesystem::path out = "explained";  ///< folder for them
  bool pose = false;                        ///< tell poses, too: from the next three
  std::optional<std::filesystem::path> camera = {}, layout = {};
  std::optional<double> size_m = {};
};
int detect(const DetectArguments& arguments, const Methods& methods);

struct ListArguments {
  bool verbose = false;
  bool json = false;
};
int list(const ListArguments& arguments, const Methods& methods);

struct InspectArguments {
  std::filesystem::path path;
  std::optional<std::filesystem::path> labels;
  std::optional<double> rate_hz;
  std::optional<std::string> format;  ///< else recognised
  std::optional<std::string> topic;   ///< ROS bags
  bool no_pictures = false;
  bool json = false;
};
int inspect(const InspectArguments& arguments);

struct CheckArguments {
  std::string methods;  ///< separated by commas; empty with `all`
  bool all = false;
  std::optional<std::string> only;  ///< one check
  int frames = 10'000;
  double budget_s = 60;
  double silence_s = 30;
  bool json = false;
};
int check(const CheckArguments& arguments, const Methods& methods);

struct SimulateArguments {
  std::optional<std::filesystem::path> plan;
  std::optional<std::string> preset;
  std::vector<std::string> targets;  ///< else the plan's
  std::optional<std::uint64_t> seed;
  std::optional<double> duration_s;
  std::optional<std::string> gaps;
  std::optional<std::filesystem::path> out;
  std::optional<std::filesystem::path> preview;
  int jobs = 1;
  bool list = false;
  bool show = false;  ///< print the plan, make nothing
};
int simulate(const SimulateArguments& arguments);

/// What is not given has the defaults of cli/map/sweep.h.
struct MapArguments {
  std::string axes = "gap,blur";
  std::vector<double> columns;       ///< slots, Hz or px
  std::vector<double> exposures_ms;  ///< the rows
  std::optional<double> gap_share;
  std::optional<int> seeds;
  std::optional<double> duration_s;
  std::optional<std::filesystem::path> flight;  ///< a plan of the flights
  std::optional<std::string> target;
  std::string methods = "csrt,medianflow,kcf,apriltag";
  std::optional<std::string> tracker, detector;  ///< who are compared; else the best over the map
  std::filesystem::path out = "map";
  int jobs = 1;
  bool quick = false;
  bool dry_run = false;
};
int map(const MapArguments& arguments, const Methods& methods);

/// What is not given has the defaults of cli/jump/jumps.h; flights are those of cli/map/sweep.h.
struct JumpArguments {
  std::string methods;                            ///< separated by commas
  std::optional<std::filesystem::path> sequence;  ///< else simulated flights
  std::optional<std::filesystem::path> labels;
  std::optional<std::filesystem::path> flight;  ///< a plan of the flights
  std::optional<std::string> target;
  std::optional<double> exposure_ms;
  int seeds = 8;
  int before = 8;  ///< frames shown between the start and the gap
  bool no_time_gap = false;
  std::filesystem::path out = "jump";
  std::optional<std::filesystem::path> plot;
  int jobs = 1;
  bool json = false;
};
int jump(const JumpArguments& arguments, const Methods& methods);

struct BenchArguments {
  std::string what;  ///< ring
  std::string method = "ring";
  std::vector<std::string> only;  ///< rows; empty: all
  std::optional<std::size_t> pictures;
  bool geometries = false;  ///< compares rings of other widths, and nothing else
  bool even_seeds = false;
  bool full = false;
  int jobs = 1;
  bool json = false;
};
int bench_detector(const BenchArguments& arguments, const Methods& methods);

struct ReproduceArguments {
  bool quick = false;
  std::optional<std::filesystem::path> out;  ///< else reproduction, or reproduction-quick
  int jobs = 1;
  std::vector<std::string> only;  ///< names of experiments; else all
  bool json = false;
};
int reproduce(const ReproduceArguments& arguments, const Methods& methods);

struct RealismArguments {
  std::filesystem::path simulated;
  std::filesystem::path real = "klahaag";
};
/// 1 when something is far from the real footage.
int realism(const RealismArguments& arguments);

struct NewArguments {
  std::string kind;  ///< detector or tracker
  std::string name;
  std::filesystem::path in = ".";  ///< where its folder goes
};
int start_new(const NewArguments& arguments, const Methods& methods);

struct MarkerArguments {
  std::vector<std::string> markers;  ///< names (cli/print/design.h), lists of them separated by commas
  std::string size;                  ///< with its unit: 150mm
  std::filesystem::path out;         ///< ends in .pdf, .svg or .png
  std::string paper = "marker";
  double dpi = 300;  ///< of .png
  RingLook rings;    ///< of those whose names do not say otherwise
  bool no_caption = false;
};
int marker(const MarkerArguments& arguments);

struct ExportArguments {
  std::filesystem::path folder;
  std::string as;  ///< vot, otb, got10k or tum
  std::filesystem::path out;
};
int export_results(const ExportArguments& arguments);

struct ImportArguments {
  std::vector<std::filesystem::path> files;  ///< one for each target
  std::string as;                            ///< vot, otb or got10k
  std::filesystem::path sequence;
  std::optional<std::filesystem::path> labels;
  std::optional<double> rate_hz;
  std::optional<std::string> format;  ///< of the recording; else recognised
  std::vector<std::string> targets;   ///< that the files are of; else all
  std::string method;
  std::filesystem::path out = "results";
};
int import_results(const ImportArguments& arguments);

struct LabelArguments {
  std::filesystem::path recording;
  std::optional<std::filesystem::path> labels;  ///< the file to write; else where the recording's belong
  std::optional<double> rate_hz;
  std::optional<std::string> format;  ///< else recognised
  std::optional<std::string> topic;   ///< ROS bags
  std::uint16_t port = 0;             ///< 0: any that is free
  std::optional<double> max_gap_s;
  double sigma_px = 1.0;                ///< of what is placed by hand, at the picture's own size
  std::optional<std::string> detector;  ///< whose answers may be taken over where the user says so
  bool no_browser = false;
  bool check = false;  ///< write the check sheet and end
  std::filesystem::path sheet = "labels-check.png";
};
int label(const LabelArguments& arguments, const Methods& methods);

struct CompatibilityArguments {
  std::filesystem::path folder;
  std::string align = "none";          ///< evo: none, rigid or similarity
  std::vector<std::size_t> eao_range;  ///< VOT: shortest and longest run; else 100 and 356, or 115 and 755
  bool json = false;
};
int compatibility(const CompatibilityArguments& arguments);

}  // namespace relock
