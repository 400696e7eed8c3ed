#include "eval/trajectory_csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <ostream>

#include "core/csv.h"
#include "core/error.h"
#include "core/outline_csv.h"

namespace relock {
namespace {

constexpr int kDecimals = 4;
const std::vector<std::string> kPlainColumns{"frame",      "captured_ns",        "report",        "track",
                                             "code",       "centre_kind",        "centre_x",      "centre_y",
                                             "confidence", "blur_direction_rad", "blur_length_px"};
const std::vector<std::string> kColumns = with_outline_columns(kPlainColumns);

class ReportWriter {
 public:
  /// Appends to `line`.
  ReportWriter(std::string& line, const Recording& recording, const Trajectory& trajectory)
      : line_(line), recording_(recording), trajectory_(trajectory) {}

  void write(std::size_t frame) {
    const FrameReport& report = trajectory_.frames[frame];
    if (report.delivery != Delivery::delivered) {
      plain(frame, report.delivery == Delivery::dropped ? "dropped" : "skipped");
      return;
    }
    for (const std::size_t t : report.given) given(frame, t);
    for (const std::size_t t : report.withheld) plain(frame, "withheld", recording_.targets[t].id);
    for (const Sighting& sighting : report.sightings) write(frame, sighting);
    if (report.given.empty() && report.sightings.empty() && report.withheld.empty())
      plain(frame, failed(frame) ? "failed" : "nothing");
  }

 private:
  /// No target is asked about any more.
  bool failed(std::size_t frame) const {
    for (std::size_t t = 0; t < recording_.targets.size(); ++t) {
      const auto& from = trajectory_.failed_from[t];
      if (trajectory_.judged_from[t] && !(from && *from <= static_cast<FrameIndex>(frame))) return false;
    }
    return true;
  }

  void begin(std::size_t frame, std::string_view report, std::string_view track) {
    fmt::format_to(std::back_inserter(line_), "{},{},{},{}", frame, ns(recording_.captured[frame]), report,
                   csv_cell(track));
  }
  void end() { line_ += '\n'; }
  void empty_cells(std::size_t count) { line_.append(count, ','); }
  void cell(double value) { fmt::format_to(std::back_inserter(line_), ",{:.{}f}", value, kDecimals); }

  void plain(std::size_t frame, std::string_view report, std::string_view track = "") {
    begin(frame, report, track);
    empty_cells(kPlainColumns.size() - 4);
    append_outline(line_, {}, kDecimals);
    end();
  }

  void given(std::size_t frame, std::size_t t) {
    begin(frame, "given", recording_.targets[t].id);
    empty_cells(kPlainColumns.size() - 4);
    append_outline(line_, Outline(bounds(*recording_.truth_of(frame, t).outline)), kDecimals);
    end();
  }

  void write(std::size_t frame, const Sighting& sighting) {
    begin(frame, "sighting", sighting.track.value_or(""));
    line_ += fmt::format(",{},{}", sighting.code ? csv_cell(to_string(*sighting.code)) : "",
                         to_string(sighting.centre_kind));
    cell(sighting.centre.x);
    cell(sighting.centre.y);
    cell(sighting.confidence);
    if (sighting.blur) {
      cell(sighting.blur->direction_rad);
      cell(sighting.blur->length_px);
    } else {
      empty_cells(2);
    }
    append_outline(line_, sighting.outline, kDecimals);
    end();
  }

  std::string& line_;
  const Recording& recording_;
  const Trajectory& trajectory_;
};

class TrajectoryReader {
 public:
  TrajectoryReader(std::istream& in, const std::string& file, const Recording& recording,
                   Trajectory& trajectory)
      : rows_(in, file), recording_(recording), frames_(trajectory.frames), outlines_(rows_) {
    rows_.expect_only(kColumns);
  }

  void read() {
    frames_.clear();
    while (rows_.next()) {
      FrameReport& report = report_of_this_row();
      const auto kind = rows_.text(report_);
      if (kind == "dropped") {
        report.delivery = Delivery::dropped;
      } else if (kind == "skipped") {
        report.delivery = Delivery::skipped;
      } else if (kind == "given") {
        add_target(report.given);
      } else if (kind == "withheld") {
        add_target(report.withheld);
      } else if (kind == "sighting") {
        add_sighting(report.sightings);
      } else if (kind != "nothing" && kind != "failed") {
        rows_.fail(fmt::format(
            "column report: \"{}\" is none of sighting, nothing, given, failed, dropped, skipped, withheld",
            kind));
      }
    }
  }

 private:
  FrameReport& report_of_this_row() {
    const std::int64_t frame = rows_.whole(frame_);
    const auto last = static_cast<std::int64_t>(frames_.size()) - 1;
    if (frame != last && frame != last + 1)
      rows_.fail(fmt::format("frame {} comes after frame {}; every recorded frame must be there, in order",
                             frame, last));
    if (frame < 0 || frame >= static_cast<std::int64_t>(recording_.frames()))
      rows_.fail(fmt::format("frame {} does not exist in {} (it has {} frames, from 0)", frame,
                             recording_.name, recording_.frames()));
    if (rows_.whole(captured_) != ns(recording_.captured[static_cast<std::size_t>(frame)]))
      rows_.fail(fmt::format("frame {} was captured at {} ns in {}; is this trajectory of another recording?",
                             frame, ns(recording_.captured[static_cast<std::size_t>(frame)]),
                             recording_.name));
    const auto kind = rows_.text(report_);
    const bool with_others = kind == "sighting" || kind == "given" || kind == "withheld";
    if (frame == last && !(with_others && last_with_others_)) there_twice();
    last_with_others_ = with_others;
    if (frame > last) frames_.emplace_back();
    return frames_.back();
  }

  [[noreturn]] void there_twice() const {
    rows_.fail(
        fmt::format("this row of frame {} is there twice; remove one, or run again", rows_.text(frame_)));
  }

  void add_target(std::vector<std::size_t>& targets) const {
    const std::size_t one = target(rows_.text(track_));
    const auto at = std::lower_bound(targets.begin(), targets.end(), one);
    if (at != targets.end() && *at == one) there_twice();
    targets.insert(at, one);
  }

  /// A replay keeps nothing that was said twice in the same words.
  void add_sighting(Sightings& sightings) const {
    Sighting seen = sighting();
    if (std::find(sightings.begin(), sightings.end(), seen) != sightings.end()) there_twice();
    sightings.push_back(std::move(seen));
  }

  std::size_t target(std::string_view id) const {
    for (std::size_t t = 0; t < recording_.targets.size(); ++t)
      if (recording_.targets[t].id == id) return t;
    rows_.fail(fmt::format("{} has no target \"{}\"", recording_.name, id));
  }

  Sighting sighting() const {
    Sighting seen;
    seen.centre = {rows_.number(centre_x_), rows_.number(centre_y_)};
    const auto outline = outlines_.read(rows_);
    if (!outline) rows_.fail("a sighting needs an outline");
    seen.outline = *outline;
    if (const auto track = rows_.text(track_); !track.empty())
      seen.track = recording_.targets[target(track)].id;
    try {
      seen.centre_kind = parse_centre_kind(rows_.text(centre_kind_));
      if (const auto code = rows_.text(code_); !code.empty()) seen.code = parse_code(code);
    } catch (const Error& fault) {
      rows_.fail(fault.what());
    }
    seen.confidence = rows_.number(confidence_);
    const auto direction = rows_.optional_number(blur_direction_),
               length = rows_.optional_number(blur_length_);
    if (direction && length) seen.blur = BlurEstimate{*direction, *length};
    return seen;
  }

  CsvReader rows_;
  const Recording& recording_;
  std::vector<FrameReport>& frames_;
  OutlineColumns outlines_;
  bool last_with_others_ = true;  // whether the last row's frame may have more rows
  CsvReader::Column frame_ = rows_.column("frame");
  CsvReader::Column captured_ = rows_.column("captured_ns");
  CsvReader::Column report_ = rows_.column("report");
  CsvReader::Column track_ = rows_.column("track");
  CsvReader::Column code_ = rows_.column("code");
  CsvReader::Column centre_kind_ = rows_.column("centre_kind");
  CsvReader::Column centre_x_ = rows_.column("centre_x");
  CsvReader::Column centre_y_ = rows_.column("centre_y");
  CsvReader::Column confidence_ = rows_.column("confidence");
  CsvReader::Column blur_direction_ = rows_.column("blur_direction_rad");
  CsvReader::Column blur_length_ = rows_.column("blur_length_px");
};

}  // namespace

Sighting as_stored(Sighting sighting) {
  const auto round = [](double& value) { value = std::round(value * 1e4) / 1e4; };
  const auto round_vector = [&](Vec2& v) { round(v.x), round(v.y); };
  round_vector(sighting.centre);
  round(sighting.confidence);
  if (sighting.blur) round(sighting.blur->direction_rad), round(sighting.blur->length_px);
  if (auto* box = std::get_if<Box>(&sighting.outline)) {
    round(box->x), round(box->y), round(box->width), round(box->height);
  } else if (auto* quad = std::get_if<Quad>(&sighting.outline)) {
    for (Vec2& corner : quad->corner) round_vector(corner);
  } else if (auto* ellipse = std::get_if<Ellipse>(&sighting.outline)) {
    round_vector(ellipse->centre);
    round(ellipse->semi_major), round(ellipse->semi_minor), round(ellipse->angle_rad);
  }
  return sighting;
}

void write_trajectory(std::ostream& out, const Recording& recording, const Trajectory& trajectory) {
  out << trajectory_header();
  std::string rows;
  for (std::size_t frame = 0; frame < trajectory.frames.size(); ++frame) {
    rows.clear();
    append_report(rows, recording, trajectory, frame);
    out << rows;
  }
}

std::string trajectory_header() { return fmt::format("{}\n", fmt::join(kColumns, ",")); }

void append_report(std::string& text, const Recording& recording, const Trajectory& trajectory,
                   std::size_t frame) {
  ReportWriter(text, recording, trajectory).write(frame);
}

void read_trajectory(std::istream& in, const std::string& file, const Recording& recording,
                     Trajectory& trajectory) {
  TrajectoryReader(in, file, recording, trajectory).read();
}

}  // namespace relock
