#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/program.h"

// One function for each verb of the program, in a file of its own. Each returns the exit status.

namespace relock {

struct RunArguments {
  std::filesystem::path sequence =
      "klahaag";  ///< a folder, or the name of a recording that relock comes with
  std::optional<std::filesystem::path> labels;
  std::optional<double> rate_hz;
  std::optional<std::string> format;  ///< else recognised
  std::optional<std::string> topic;   ///< ROS bags
  std::string methods;
  std::string protocol = "once";
  std::string gaps = "none";
  std::uint64_t seed = 1;
  std::string gate = "centre";
  std::filesystem::path out = "results";
};
int run(const RunArguments& arguments, const Methods& methods);

struct ScoreArguments {
  std::filesystem::path folder;
  std::optional<std::string> gate;  ///< else the one by which resets were judged, else centre
  bool json = false;
};
int score(const ScoreArguments& arguments);

struct TimelineArguments {
  std::filesystem::path folder;
  std::optional<std::string> gate;    ///< else the one by which resets were judged, else centre
  std::optional<std::string> target;  ///< only this one
  bool ascii = false;
};
int timeline(const TimelineArguments& arguments);

struct DetectArguments {
  std::vector<std::filesystem::path> images;
  std::string method;
  bool json = false;
  std::optional<std::filesystem::path> draw;
};
int detect(const DetectArguments& arguments, const Methods& methods);

struct ListArguments {
  bool verbose = false;
  bool json = false;
};
int list(const ListArguments& arguments, const Methods& methods);

struct NewArguments {
  std::string kind;  ///< detector or tracker
  std::string name;
  std::filesystem::path in = ".";  ///< where its folder goes
};
int start_new(const NewArguments& arguments, const Methods& methods);

}  // namespace relock
