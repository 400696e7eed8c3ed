#include "cli/labelling/desk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "cli/files.h"
#include "core/error.h"
#include "sequences/labels.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kUndos = 1000;

std::size_t index_of(const std::vector<KeyedTarget>& targets, const std::string& id) {
  const auto at =
      std::find_if(targets.begin(), targets.end(), [&](const KeyedTarget& t) { return t.id == id; });
  if (at == targets.end()) throw Error(fmt::format("there is no target \"{}\"", id));
  return static_cast<std::size_t>(at - targets.begin());
}

/// One letter for each frame: v visible, a absent, o occluded with its place known, u unlabelled, ? nobody said.
std::string letters(const FilledTarget& filled) {
  std::string all;
  for (std::size_t frame = 0; frame < filled.truth.size(); ++frame) {
    const TargetTruth& truth = filled.truth[frame];
    all += truth.label == Label::visible                ? 'v'
           : truth.label == Label::absent               ? 'a'
           : filled.rests_on[frame] == RestsOn::unknown ? '?'
           : truth.outline                              ? 'o'
                                                        : 'u';
  }
  return all;
}

Json rounded(double value) { return std::isfinite(value) ? Json(std::round(100 * value) / 100) : Json(); }

Json frames_json(const FilledTarget& filled) {
  Json outlines = Json::array(), sigmas = Json::array();
  for (const TargetTruth& truth : filled.truth) {
    Json outline;
    if (truth.outline) add_outline(outline, *truth.outline);
    outlines.push_back(outline);
    sigmas.push_back(truth.outline ? rounded(truth.sigma_px) : Json());
  }
  return {{"labels", letters(filled)}, {"outlines", outlines}, {"sigma_px", sigmas}};
}

Json to_json(const ClicksToGo& to_go) {
  Json next;
  if (to_go.next) next = {{"frame", to_go.next->frame}, {"worth", to_string(to_go.next->worth)}};
  return {{"next", next}, {"count", to_go.count}};
}

}  // namespace

Recording labelled(const Sequence& sequence, std::span<const KeyedTarget> targets,
                   std::span<const FilledTarget> filled) {
  Recording recording = sequence.recording;
  for (const KeyedTarget& target : targets) {
    const bool known = std::any_of(recording.targets.begin(), recording.targets.end(),
                                   [&](const Target& t) { return t.id == target.id; });
    if (!known) recording.targets.push_back({target.id});
  }
  recording.truth.assign(recording.frames() * recording.targets.size(), {});
  for (std::size_t t = 0; t < recording.targets.size(); ++t)
    for (std::size_t k = 0; k < targets.size(); ++k)
      if (targets[k].id == recording.targets[t].id)
        for (std::size_t frame = 0; frame < recording.frames(); ++frame)
          recording.truth_of(frame, t) = filled[k].truth[frame];
  return recording;
}

LabelDesk::LabelDesk(Sequence sequence, std::optional<double> max_gap_s)
    : sequence_(std::move(sequence)), keys_file_(key_file_of(sequence_.labels)) {
  document_.recording = keyed_recording(sequence_);
  open();
  if (max_gap_s) document_.max_gap_s = *max_gap_s;
  fill_changed({});
  const bool stale = !fs::exists(sequence_.labels) || read_file(sequence_.labels) != labels_text();
  if (stale && !on_disk_.empty()) save();
}

void LabelDesk::open() {
  const fs::path& labels = sequence_.labels;
  if (fs::exists(keys_file_)) {
    on_disk_ = read_file(keys_file_);
    document_ = parse_keys(on_disk_, keys_file_.string(), document_.recording);
    const auto& known = document_.labels;
    if (fs::exists(labels) &&
        std::find(known.begin(), known.end(), text_fingerprint(read_file(labels))) == known.end())
      throw Error(fmt::format(
          "{} is not what relock label wrote there; move it away to have it made again from {}, or "
          "name another file with --labels",
          labels.string(), keys_file_.string()));
  } else if (fs::exists(labels)) {
    throw Error(fmt::format(
        "{} is there already and not made by relock label, which would write over it; move it away, "
        "or name another file with --labels",
        labels.string()));
  }
  for (const Target& target : sequence_.recording.targets) {
    const bool there = std::any_of(document_.targets.begin(), document_.targets.end(),
                                   [&](const KeyedTarget& t) { return t.id == target.id; });
    if (!there) document_.targets.push_back({target.id, {}});
  }
  if (document_.targets.empty()) document_.targets.push_back({"target", {}});
}

FillOptions LabelDesk::options() const { return {.max_gap_s = document_.max_gap_s}; }

void LabelDesk::fill_changed(const std::vector<KeyedTarget>& before) {
  filled_.resize(document_.targets.size());
  for (std::size_t t = 0; t < document_.targets.size(); ++t)
    if (t >= before.size() || before[t] != document_.targets[t])
      filled_[t] =
          fill(document_.targets[t], sequence_.recording.captured, sequence_.recording.picture, options());
}

std::string LabelDesk::labels_text() const {
  std::ostringstream text;
  write_labels(text, labelled(sequence_, document_.targets, filled_));
  return text.str();
}

void LabelDesk::save() {
  if (fs::exists(keys_file_) ? read_file(keys_file_) != on_disk_ : !on_disk_.empty())
    throw Error(
        fmt::format("{} was changed by somebody else, another `relock label` perhaps; start this one again",
                    keys_file_.string()));
  const std::string labels = labels_text();
  KeyDocument document = document_;
  document.labels = {text_fingerprint(labels)};
  if (!document_.labels.empty()) document.labels.push_back(document_.labels.front());
  const std::string text = to_json_text(document);
  write_file(keys_file_, text);
  on_disk_ = text;
  document_.labels = document.labels;
  write_file(sequence_.labels, labels);
}

void LabelDesk::change(std::vector<KeyedTarget> targets) {
  std::vector<KeyedTarget> before = std::exchange(document_.targets, std::move(targets));
  const auto filled_before = filled_;
  try {
    fill_changed(before);
    save();
  } catch (...) {
    document_.targets = before;
    filled_ = filled_before;
    throw;
  }
  done_.push_back(std::move(before));
  if (done_.size() > kUndos) done_.erase(done_.begin());
  ++version_;
}

void LabelDesk::edit(const Json& request) {
  const std::string what = request.at("do");
  std::vector<KeyedTarget> targets = document_.targets;
  if (what == "undo") {
    if (done_.empty()) throw Error("there is nothing to undo");
    change(done_.back());
    done_.resize(done_.size() - 2);
    return;
  }
  if (what == "target") {
    const std::string id = request.at("id");
    if (!sequence_.recording.targets.empty())
      throw Error("recording.toml says which targets there are; add it there and start again");
    if (id.empty() || id.size() > 100 ||
        std::any_of(id.begin(), id.end(), [](unsigned char c) { return c < 32; }))
      throw Error("a target's name is one line of up to 100 letters");
    for (const KeyedTarget& target : targets)
      if (target.id == id) throw Error(fmt::format("there is a target \"{}\" already", id));
    targets.push_back({id, {}});
  } else if (what == "key") {
    put_key(targets[index_of(targets, request.at("target"))], parse_key(request, document_.recording));
  } else if (what == "take") {
    if (!take_key(targets[index_of(targets, request.at("target"))], request.at("frame")))
      throw Error("there is no key frame to take away");
  } else {
    throw Error(fmt::format("\"{}\" is nothing that can be done", what));
  }
  change(std::move(targets));
}

Json LabelDesk::state(const Likenesses& likenesses) const {
  const Recording& recording = sequence_.recording;
  Json times = Json::array(), targets = Json::array();
  for (const Time t : recording.captured)
    times.push_back(std::round(1e6 * seconds(t - recording.captured[0])) / 1e6);
  for (std::size_t t = 0; t < document_.targets.size(); ++t) {
    const KeyedTarget& target = document_.targets[t];
    Json keys = Json::array(), like = Json::array();
    for (const KeyFrame& key : target.keys) keys.push_back(relock::to_json(key));
    const std::vector<double> likeness = t < likenesses.size() ? likenesses[t] : std::vector<double>{};
    for (const double each : likeness) like.push_back(rounded(each));
    targets.push_back(
        {{"id", target.id},
         {"keys", keys},
         {"frames", frames_json(filled_[t])},
         {"likeness", like},
         {"to_go", to_json(clicks_to_go(target, filled_[t], recording.captured, likeness, options()))}});
  }
  return {
      {"version", version_},
      {"recording",
       {{"name", recording.name},
        {"frames", recording.frames()},
        {"width", recording.picture.width},
        {"height", recording.picture.height},
        {"period_s", seconds(recording.period)},
        {"times_s", times}}},
      {"files", {{"labels", sequence_.labels.filename().string()}, {"keys", keys_file_.filename().string()}}},
      {"may_add_targets", recording.targets.empty()},
      {"undo", done_.size()},
      {"targets", targets}};
}

}  // namespace relock
