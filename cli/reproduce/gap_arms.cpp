#include "cli/reproduce/gap_arms.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "core/error.h"
#include "sequences/open.h"
#include "sequences/simulator/draft.h"
#include "sequences/timestamps.h"

namespace relock::reproduction {
namespace {

namespace fs = std::filesystem;

/// The slots of `count` frames that arrive, rising.
std::vector<FrameIndex> arriving(std::size_t count, Duration period, const GapPattern& pattern,
                                 std::uint64_t seed) {
  // What a pattern does to the first slots does not depend on how many follow.
  for (std::size_t slots = 2 * count;; slots *= 2) {
    std::vector<Time> times;
    for (std::size_t i = 0; i < slots; ++i) times.push_back(Time{static_cast<std::int64_t>(i) * period});
    const std::array<FrameIndex, 1> first{0};
    const Schedule schedule = pattern.apply(times, period, seed, first);
    std::vector<FrameIndex> arrived;
    for (std::size_t i = 0; i < slots && arrived.size() < count; ++i)
      if (schedule.delivered(i)) arrived.push_back(static_cast<FrameIndex>(i));
    if (arrived.size() == count) return arrived;
  }
}

std::vector<fs::path> pictures_of(const fs::path& flight) {
  std::vector<fs::path> pictures;
  for (const auto& file : fs::directory_iterator(flight / "images"))
    pictures.push_back(file.path().filename());
  std::ranges::sort(pictures);
  return pictures;
}

void write_times(const fs::path& file, const Cut& cut, const std::vector<fs::path>& pictures) {
  std::ofstream times(file, std::ios::binary);
  times << "timestamp_ns,frame,file\n";
  for (std::size_t i = 0; i < cut.frames.size(); ++i)
    times << fmt::format("{},{},{}\n", ns(cut.captured[i]), i,
                         pictures.at(static_cast<std::size_t>(cut.frames[i])).string());
  if (!times.flush()) throw Error(fmt::format("{} cannot be written; is the disk full?", file.string()));
}

}  // namespace

std::string_view to_string(GapArm arm) {
  switch (arm) {
    case GapArm::all_frames:
      return "all frames";
    case GapArm::pauses:
      return "pauses";
    case GapArm::jumps:
      return "jumps";
    case GapArm::gaps:
      break;
  }
  return "gaps";
}

bool jumps(GapArm arm) { return arm == GapArm::jumps || arm == GapArm::gaps; }
bool pauses(GapArm arm) { return arm == GapArm::pauses || arm == GapArm::gaps; }

Cut cut(GapArm arm, std::span<const Time> captured, Duration period, const GapPattern& pattern,
        std::uint64_t seed) {
  const std::vector<FrameIndex> slots = arriving(captured.size(), period, pattern, seed);
  Cut cut;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const auto rank = static_cast<FrameIndex>(i);
    const FrameIndex frame = jumps(arm) ? slots[i] : rank;
    if (frame >= static_cast<FrameIndex>(captured.size())) break;
    cut.frames.push_back(frame);
    cut.captured.push_back(captured.front() + (pauses(arm) ? slots[i] : rank) * period);
  }
  return cut;
}

Recording cut_recording(const Recording& flight, const Cut& cut, const std::string& name) {
  Recording recording = flight;
  recording.name = name;
  recording.captured = cut.captured;
  recording.truth.clear();
  for (const FrameIndex frame : cut.frames)
    for (std::size_t t = 0; t < flight.targets.size(); ++t)
      recording.truth.push_back(flight.truth_of(static_cast<std::size_t>(frame), t));
  return recording;
}

void write_cut(const fs::path& flight, const Recording& truth, const Cut& cut, const fs::path& out) {
  if (fs::exists(out)) return;
  simulator::Draft draft(out);
  simulator::make_folder(draft.path());
  write_truth(draft.path(), truth);
  write_times(draft.path() / "timestamps.csv", cut, pictures_of(flight));
  std::error_code fault;
  fs::create_directory_symlink(fs::path("..") / flight.filename() / "images", draft.path() / "images", fault);
  if (fault) throw Error(fmt::format("{} cannot be linked: {}", (out / "images").string(), fault.message()));
  draft.put_in_place();
}

}  // namespace relock::reproduction
