#include "sequences/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <istream>
#include <ostream>

#include "core/csv.h"
#include "core/error.h"
#include "core/nearest.h"
#include "core/outline_csv.h"

namespace relock {
namespace {

constexpr int kDecimals = 4;
const std::vector<std::string> kPlainColumns{
    "frame",  "target", "label",    "projected_x", "projected_y", "visible_fraction", "occluded_fraction",
    "blur_x", "blur_y", "tilt_deg", "sigma_px"};
constexpr const char* kSource = "source";

/// In the order in which they are written; the source, which older files have not, comes last.
std::vector<std::string> columns(SourceColumn source) {
  std::vector<std::string> all = with_outline_columns(kPlainColumns);
  if (source == SourceColumn::written) all.emplace_back(kSource);
  return all;
}

/// Of a quad: where its diagonals meet.
std::optional<Vec2> projected_centre(const Outline& outline) {
  if (const auto* quad = std::get_if<Quad>(&outline)) return diagonals_meet(*quad);
  return {};
}

/// One labels file being read.
class LabelReader {
 public:
  LabelReader(std::istream& in, const std::string& file, const Description& description,
              const LabelLimits& limits, Recording& recording)
      : rows_(in, file), description_(description), limits_(limits), recording_(recording), outlines_(rows_) {
    rows_.expect_only(columns(SourceColumn::written));
    for (const auto& entry : description.targets) recording_.targets.push_back(entry.target);
  }

  void read() {
    struct Row {
      std::size_t frame, target;
      TargetTruth truth;
    };
    std::vector<Row> rows;
    while (rows_.next()) rows.push_back({read_frame(), read_target(), read_truth()});
    recording_.truth.assign(recording_.frames() * recording_.targets.size(), TargetTruth{});
    for (Row& row : rows) recording_.truth_of(row.frame, row.target) = std::move(row.truth);
  }

 private:
  std::size_t read_frame() {
    const std::int64_t frame = rows_.whole(frame_);
    if (frame < 0 || frame >= static_cast<std::int64_t>(recording_.frames()))
      rows_.fail(
          fmt::format("frame {} does not exist in {} (it has {} frames, from 0); were these labels made "
                      "for another recording?",
                      frame, recording_.name, recording_.frames()));
    return static_cast<std::size_t>(frame);
  }

  std::size_t read_target() {
    std::string id(rows_.text(target_));
    if (id.empty()) id = only_target();
    if (id.find_first_of("\r\n") != std::string::npos) rows_.fail("a target's id is one line");
    auto at = std::find_if(recording_.targets.begin(), recording_.targets.end(),
                           [&](const Target& t) { return t.id == id; });
    if (at == recording_.targets.end()) {
      if (!description_.targets.empty()) rows_.fail(unknown_target(id));
      at = recording_.targets.insert(at, Target{id});
    }
    const auto target = static_cast<std::size_t>(at - recording_.targets.begin());
    seen_.resize(std::max(seen_.size(), target + 1), std::vector<bool>(recording_.frames()));
    const auto frame = static_cast<std::size_t>(rows_.whole(frame_));
    if (seen_[target][frame]) rows_.fail(fmt::format("target {} is labelled twice on frame {}", id, frame));
    seen_[target][frame] = true;
    return target;
  }

  std::string only_target() const {
    if (description_.targets.size() > 1)
      rows_.fail("there are several targets; say which one in column target");
    return description_.targets.empty() ? "target" : description_.targets[0].target.id;
  }

  std::string unknown_target(const std::string& id) const {
    std::vector<std::string> known;
    for (const Target& target : recording_.targets) known.push_back(target.id);
    return fmt::format("recording.toml knows no target \"{}\"{}", id, did_you_mean(id, known));
  }

  TargetTruth read_truth() {
    TargetTruth truth;
    truth.outline = outlines_.read(rows_);
    truth.centre_projected = read_vector(projected_x_, projected_y_);
    if (!truth.centre_projected && truth.outline) truth.centre_projected = projected_centre(*truth.outline);
    truth.occluded_fraction = read_fraction(occluded_fraction_).value_or(0);
    const double inside = truth.outline ? share_inside(*truth.outline, picture_box(recording_.picture)) : 0;
    truth.visible_fraction =
        read_fraction(visible_fraction_).value_or(std::max(0.0, inside - truth.occluded_fraction));
    truth.blur = read_vector(blur_x_, blur_y_);
    truth.tilt_deg = rows_.optional_number(tilt_deg_);
    truth.sigma_px = rows_.optional_number(sigma_px_).value_or(default_sigma_px());
    if (truth.sigma_px < 0) rows_.fail("column sigma_px: it must not be below 0");
    truth.source = read_source();
    truth.label = read_label(truth);
    if (truth.label == Label::visible) {
      if (!truth.outline) rows_.fail("a visible target needs an outline");
      if (inside == 0) rows_.fail(outside(*truth.outline));
    }
    return truth;
  }

  LabelSource read_source() {
    try {
      return parse_label_source(rows_.text(source_));
    } catch (const Error& fault) {
      rows_.fail(fmt::format("column source: {}", fault.what()));
    }
  }

  Label read_label(const TargetTruth& truth) const {
    const auto text = rows_.text(label_);
    if (text == "visible") return Label::visible;
    if (text == "absent") return Label::absent;
    if (text == "unlabelled") return Label::unlabelled;
    if (!text.empty())
      rows_.fail(fmt::format("column label: \"{}\" is none of visible, absent, unlabelled", text));
    const bool says_fraction = !rows_.text(visible_fraction_).empty();
    if (!says_fraction && truth.visible_fraction == 0 && truth.occluded_fraction == 0) {
      if (truth.outline) rows_.fail(outside(*truth.outline));
      rows_.fail("this row says nothing: give an outline, a label or a visible_fraction");
    }
    return label_of(truth.visible_fraction, limits_);
  }

  std::string outside(const Outline& outline) const {
    const Box box = bounds(outline);
    return fmt::format(
        "the target at x {:.1f} to {:.1f}, y {:.1f} to {:.1f} lies outside the picture of {}x{}; "
        "write label absent if that is meant, or were these labels made for another recording?",
        box.x, box.right(), box.y, box.bottom(), recording_.picture.width, recording_.picture.height);
  }

  std::optional<Vec2> read_vector(CsvReader::Column x, CsvReader::Column y) const {
    const auto vx = rows_.optional_number(x), vy = rows_.optional_number(y);
    if (vx.has_value() != vy.has_value()) rows_.fail("a vector needs both its x and its y");
    if (!vx) return {};
    return Vec2{*vx, *vy};
  }

  std::optional<double> read_fraction(CsvReader::Column column) const {
    const auto value = rows_.optional_number(column);
    if (value && (*value < 0 || *value > 1))
      rows_.fail(fmt::format("column {}: {} is not between 0 and 1", rows_.header()[column], *value));
    return value;
  }

  double default_sigma_px() const {
    const std::string id(rows_.text(target_));
    for (const auto& entry : description_.targets)
      if ((id.empty() || entry.target.id == id) && entry.sigma_px) return *entry.sigma_px;
    return description_.sigma_px;
  }

  CsvReader rows_;
  const Description& description_;
  const LabelLimits& limits_;
  Recording& recording_;
  OutlineColumns outlines_;
  CsvReader::Column frame_ = rows_.column("frame");
  CsvReader::Column target_ = rows_.optional_column("target");
  CsvReader::Column label_ = rows_.optional_column("label");
  CsvReader::Column projected_x_ = rows_.optional_column("projected_x");
  CsvReader::Column projected_y_ = rows_.optional_column("projected_y");
  CsvReader::Column visible_fraction_ = rows_.optional_column("visible_fraction");
  CsvReader::Column occluded_fraction_ = rows_.optional_column("occluded_fraction");
  CsvReader::Column blur_x_ = rows_.optional_column("blur_x");
  CsvReader::Column blur_y_ = rows_.optional_column("blur_y");
  CsvReader::Column tilt_deg_ = rows_.optional_column("tilt_deg");
  CsvReader::Column sigma_px_ = rows_.optional_column("sigma_px");
  CsvReader::Column source_ = rows_.optional_column(kSource);
  std::vector<std::vector<bool>> seen_;  // for each target, which frames are labelled
};

void append(std::string& line, const std::optional<double>& value) {
  line += ',';
  if (value) fmt::format_to(std::back_inserter(line), "{:.{}f}", *value, kDecimals);
}

void append(std::string& line, const std::optional<Vec2>& value) {
  append(line, value ? std::optional(value->x) : std::nullopt);
  append(line, value ? std::optional(value->y) : std::nullopt);
}

}  // namespace

Label label_of(double visible_fraction, const LabelLimits& limits) {
  if (visible_fraction <= limits.absent) return Label::absent;
  return visible_fraction >= limits.visible ? Label::visible : Label::unlabelled;
}

TargetTruth truth_of_outline(const Outline& outline, Size picture, const LabelLimits& limits) {
  TargetTruth truth;
  truth.visible_fraction = share_inside(outline, picture_box(picture));
  truth.label = truth.visible_fraction > 0 ? label_of(truth.visible_fraction, limits) : Label::absent;
  if (truth.visible_fraction == 0) return truth;
  truth.outline = outline;
  truth.centre_projected = projected_centre(outline);
  return truth;
}

void read_labels(std::istream& in, const std::string& file, const Description& description,
                 const LabelLimits& limits, Recording& recording) {
  LabelReader(in, file, description, limits, recording).read();
}

void write_label_header(std::ostream& out, SourceColumn source) {
  out << fmt::format("{}", fmt::join(columns(source), ",")) << '\n';
}

void write_label_row(std::ostream& out, FrameIndex frame, const Target& target, const TargetTruth& truth,
                     SourceColumn source) {
  if (truth.label == Label::unlabelled && !truth.outline) return;
  std::string line = fmt::format("{},{},{}", frame, csv_cell(target.id), to_string(truth.label));
  append(line, truth.centre_projected);
  append(line, truth.visible_fraction);
  append(line, truth.occluded_fraction);
  append(line, truth.blur);
  append(line, truth.tilt_deg);
  append(line, truth.sigma_px);
  append_outline(line, truth.outline, kDecimals);
  if (source == SourceColumn::written) line += "," + csv_cell(to_string(truth.source));
  out << line << '\n';
}

void write_labels(std::ostream& out, const Recording& recording) {
  const bool stated = std::any_of(recording.truth.begin(), recording.truth.end(),
                                  [](const TargetTruth& truth) { return truth.source != LabelSource{}; });
  const SourceColumn source = stated ? SourceColumn::written : SourceColumn::left_out;
  write_label_header(out, source);
  for (std::size_t frame = 0; frame < recording.frames(); ++frame)
    for (std::size_t t = 0; t < recording.targets.size(); ++t)
      write_label_row(out, static_cast<FrameIndex>(frame), recording.targets[t], recording.truth_of(frame, t),
                      source);
}

}  // namespace relock
