#pragma once

#include <filesystem>
#include <vector>

#include "cli/verbs.h"

namespace CLI {
class App;
}

namespace relock {

/// The arguments of all verbs, filled in by CLI11.
struct Arguments {
  RunArguments run;
  ScoreArguments score;
  CompareArguments compare;
  ResultsArguments cost, survival, attribute;
  GainArguments gain;
  ExplainArguments explain;
  TimelineArguments timeline;
  ReportArguments report;
  VideoArguments video;
  DetectArguments detect;
  ListArguments list;
  InspectArguments inspect;
  CheckArguments check;
  NewArguments start_new;
  SimulateArguments simulate;
  MapArguments map;
  JumpArguments jump;
  BenchArguments bench;
  ReproduceArguments reproduce;
  RealismArguments realism;
  MarkerArguments marker;
  ExportArguments export_results;
  ImportArguments import_results;
  CompatibilityArguments compatibility;
  LabelArguments label;
  std::vector<std::filesystem::path> plugins;  // of any verb that names methods
};

/// Tells `app` of every verb and where its arguments go.
void add_verbs(CLI::App& app, Arguments& arguments);

}  // namespace relock
