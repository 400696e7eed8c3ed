#include "cli/report/pictures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <tuple>

#include "cli/report/encoded.h"
#include "cli/runs/source.h"
#include "cli/terminal.h"
#include "core/error.h"
#include "core/opencv.h"

namespace relock::reports {
namespace {

constexpr int kWidest = 640, kNarrowest = 240, kQuality = 75;
constexpr double kBytesOfPixel =
    0.18;  // of a JPEG of this quality, as base64: a guess that decides the width only

/// How much a picture is wanted: what it shows, and the how-manieth of its kind in its lane. Less is more.
using Want = std::pair<int, std::size_t>;
using Wants = std::map<FrameIndex, Want>;  ///< by frame as recorded

/// A recording that comparisons were made on.
struct Album {
  std::string name;
  std::filesystem::path truth_beside;  ///< of which comparison
  Wants wants;
  std::map<FrameIndex, std::string> pictures;  ///< JPEG, as data: URL
};

bool backward(const StoredComparison& comparison) {
  const auto& anchor = comparison.runs.front().record.anchor;
  return anchor && anchor->direction == Direction::backward;
}

/// Of a frame as it was played.
FrameIndex as_recorded(const StoredComparison& comparison, FrameIndex frame) {
  const auto last =
      static_cast<FrameIndex>(std::max(comparison.recorded_frames, comparison.recording.frames())) - 1;
  return backward(comparison) ? last - frame : frame;
}

void want(Wants& wants, FrameIndex frame, const Want& how_much) {
  const auto [at, added] = wants.try_emplace(frame, how_much);
  if (!added) at->second = std::min(at->second, how_much);
}

std::optional<FrameIndex> worst_frame(const TargetTimeline& timeline) {
  std::optional<FrameIndex> worst;
  double most = 0;
  for (std::size_t frame = 0; frame < timeline.judgements.size(); ++frame)
    if (const double error = timeline.judgements[frame].error_px; error > most)
      most = error, worst = static_cast<FrameIndex>(frame);
  return worst;
}

/// Yardsticks lose what they are made to lose: what they did matters least.
void want_events(const ScoredComparison& compared, std::size_t run, std::size_t target, Wants& wants) {
  const StoredComparison& stored = compared.stored;
  const int less = stored.runs[run].record.yardstick ? 10 : 0;
  const TargetTimeline& timeline = compared.evaluations[run].targets[target];
  const auto add = [&](FrameIndex frame, int kind, std::size_t rank) {
    want(wants, as_recorded(stored, frame), {kind + less, rank});
  };
  for (std::size_t i = 0; i < timeline.losses.size(); ++i) {
    const Loss& loss = timeline.losses[i];
    const std::size_t tier = i / 4;  // the first losses of all methods, whole, before the next
    add(loss.first_lost, 0, 3 * tier);
    add(loss.last_good, 0, 3 * tier + 1);
    add(loss.end_frame, 0, 3 * tier + 2);
  }
  if (const auto start = stored.runs[run].trajectory.judged_from[target]) add(*start, 1, 0);
  if (const auto worst = worst_frame(timeline)) add(*worst, 2, 0);
}

std::vector<Album> albums_of(const std::vector<ScoredComparison>& all, std::vector<std::size_t>& album_of) {
  std::vector<Album> albums;
  for (const ScoredComparison& compared : all) {
    const std::string& name = compared.stored.recording.name;
    auto album = std::find_if(albums.begin(), albums.end(), [&](const Album& a) { return a.name == name; });
    if (album == albums.end())
      album = albums.insert(album, Album{name, compared.stored.folder.parent_path(), {}, {}});
    album_of.push_back(static_cast<std::size_t>(album - albums.begin()));
    for (std::size_t run = 0; run < compared.stored.runs.size(); ++run)
      for (std::size_t t = 0; t < compared.stored.recording.targets.size(); ++t)
        if (compared.stored.runs[run].trajectory.judged_from[t]) want_events(compared, run, t, album->wants);
  }
  return albums;
}

/// The most wanted frames, so many that the narrowest pictures of them may fit. Returns how many were wanted.
std::size_t keep_most_wanted(std::vector<Album>& albums, double narrow_bytes, std::size_t budget) {
  using Ranked = std::tuple<Want, FrameIndex, std::size_t>;
  std::vector<Ranked> all;
  for (std::size_t a = 0; a < albums.size(); ++a)
    for (const auto& [frame, how_much] : albums[a].wants) all.emplace_back(how_much, frame, a);
  std::sort(all.begin(), all.end());
  const auto most = static_cast<std::size_t>(1.5 * static_cast<double>(budget) / narrow_bytes) + 1;
  for (std::size_t i = most; i < all.size(); ++i)
    albums[std::get<2>(all[i])].wants.erase(std::get<1>(all[i]));
  return all.size();
}

std::string jpeg(const Image& image, int width) {
  cv::Mat small = read_only_mat(image);
  if (small.cols > width)
    cv::resize(small, small, {width, std::max(1, small.rows * width / small.cols)}, 0, 0, cv::INTER_AREA);
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", small, bytes, {cv::IMWRITE_JPEG_QUALITY, kQuality});
  return "data:image/jpeg;base64," + base64(bytes);
}

Sequence opened(const Album& album, const PictureOptions& options) {
  const StoredTruth truth = read_stored_truth(album.truth_beside);
  for (const auto& path : options.sequences)
    if (path.filename() == album.name || path.stem() == album.name || options.sequences.size() == 1)
      return open_source(truth, path);
  return open_source(truth);
}

/// In one pass; pixels of other frames are not decoded where that is possible.
void take(Album& album, const Sequence& sequence, int width, Progress& progress) {
  const auto frames = sequence.frames();
  std::size_t left = album.wants.size();
  while (left > 0) {
    const auto stamp = frames->next();
    if (!stamp) break;
    if (!album.wants.contains(stamp->index)) continue;
    album.pictures[stamp->index] = jpeg(frames->image(), width);
    --left;
    progress.done(1);
  }
}

/// Leaves out the least wanted pictures until all fit.
std::size_t keep_within(std::vector<Album>& albums, std::size_t budget) {
  std::vector<std::tuple<Want, FrameIndex, std::size_t>> all;
  for (std::size_t a = 0; a < albums.size(); ++a)
    for (const auto& [frame, picture] : albums[a].pictures)
      all.emplace_back(albums[a].wants.at(frame), frame, a);
  std::sort(all.begin(), all.end());
  std::size_t spent = 0, kept = 0;
  for (const auto& [how_much, frame, a] : all) {
    const std::size_t bytes = albums[a].pictures[frame].size();
    if (spent + bytes > budget) {
      albums[a].pictures.erase(frame);
    } else {
      spent += bytes, ++kept;
    }
  }
  return kept;
}

Json said_json(const FrameReport& report) {
  Json all = Json::array();
  for (const Sighting& sighting : report.sightings) {
    Json json{{"o", outline_json(sighting.outline)},
              {"c", {rounded(sighting.centre.x, 1), rounded(sighting.centre.y, 1)}}};
    if (sighting.track) json["t"] = *sighting.track;
    if (sighting.code) json["t"] = to_string(*sighting.code);
    all.push_back(std::move(json));
  }
  return all;
}

/// The frames of which there is a picture: [{"f": frame, "p": which picture, "truth": […], "said": [of each run]}, …].
Json shown_json(const StoredComparison& comparison, const Album& album) {
  Json all = Json::array();
  for (std::size_t frame = 0; frame < comparison.recording.frames(); ++frame) {
    const auto picture = album.pictures.find(as_recorded(comparison, static_cast<FrameIndex>(frame)));
    if (picture == album.pictures.end()) continue;
    Json truth = Json::array(), said = Json::array();
    for (std::size_t t = 0; t < comparison.recording.targets.size(); ++t) {
      const TargetTruth& of = comparison.recording.truth_of(frame, t);
      truth.push_back(of.outline && of.label == Label::visible ? outline_json(*of.outline) : Json());
    }
    for (const StoredRun& run : comparison.runs) said.push_back(said_json(run.trajectory.frames[frame]));
    all.push_back({{"f", frame},
                   {"p", std::distance(album.pictures.begin(), picture)},
                   {"truth", std::move(truth)},
                   {"said", std::move(said)}});
  }
  return all;
}

int width_for(std::size_t pictures, std::size_t budget, const Size& picture) {
  if (pictures == 0 || picture.width == 0) return kWidest;
  const double pixels = static_cast<double>(budget) / (kBytesOfPixel * static_cast<double>(pictures));
  const double width = std::sqrt(pixels * picture.width / std::max(1, picture.height));
  return std::clamp(static_cast<int>(width / 16) * 16, kNarrowest, kWidest);
}

}  // namespace

Pictures pictures_of(const std::vector<ScoredComparison>& all, const PictureOptions& options) {
  Pictures result;
  std::vector<std::size_t> album_of;
  auto albums = albums_of(all, album_of);
  const Size picture = all.front().stored.recording.picture;
  const double narrow = kBytesOfPixel * kNarrowest * kNarrowest * picture.height / std::max(1, picture.width);
  result.wanted = keep_most_wanted(albums, std::max(narrow, 1000.), options.budget_bytes);
  std::size_t tried = 0;
  for (const Album& album : albums) tried += album.wants.size();
  const int width = width_for(tried, options.budget_bytes, picture);
  Progress progress("pictures", static_cast<std::int64_t>(tried));
  for (Album& album : albums) {
    try {
      take(album, opened(album, options), width, progress);
    } catch (const Error& fault) {
      result.missing.push_back(fault.what());
    }
  }
  result.kept = keep_within(albums, options.budget_bytes);
  for (const Album& album : albums) {
    Json pictures = Json::array();
    for (const auto& [frame, url] : album.pictures) pictures.push_back(url);
    result.recordings.push_back({{"name", album.name}, {"pictures", std::move(pictures)}});
  }
  for (std::size_t i = 0; i < all.size(); ++i)
    result.of_comparisons.push_back(
        {{"recording", album_of[i]}, {"shown", shown_json(all[i].stored, albums[album_of[i]])}});
  return result;
}

}  // namespace relock::reports
