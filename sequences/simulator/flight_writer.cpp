#include "sequences/simulator/flight_writer.h"

#include <fmt/format.h>

#include "core/csv.h"
#include "core/error.h"
#include "sequences/labels.h"
#include "sequences/open.h"

namespace relock::simulator {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTruthHeader =
    "frame,target,exposure_s,gain,motion_px,steps,outline_middle_x,outline_middle_y,projected_middle_x,"
    "projected_middle_y,bend_px,border_px,x_m,y_m,z_m,rotation_x_rad,rotation_y_rad,rotation_z_rad\n";

std::string truth_row(FrameIndex rank, const Target& target, const FlownFrame& frame,
                      const FlightTruth& truth) {
  std::string row = fmt::format("{},{},{:.9f},{:.6f},{:.4f},{}", rank, csv_cell(target.id), frame.exposure_s,
                                frame.gain, frame.motion_px, frame.steps);
  if (!truth.in_front) return row + ",,,,,,,,,,,,\n";
  const auto& t = truth.translation_m;
  const auto& r = truth.rotation_rad;
  return row +
         fmt::format(",{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f}\n",
                     truth.outline_middle.x, truth.outline_middle.y, truth.projected_middle.x,
                     truth.projected_middle.y, truth.bend_px, truth.border_px, t.x(), t.y(), t.z(), r.x(),
                     r.y(), r.z());
}

}  // namespace

FlightWriter::FlightWriter(const fs::path& out, std::vector<Target> targets, std::string picture_suffix)
    : draft_(out), targets_(std::move(targets)), suffix_(std::move(picture_suffix)) {
  make_folder(draft_.path() / "images");
  times_.open(draft_.path() / "timestamps.csv", std::ios::binary);
  labels_.open(draft_.path() / "labels.csv", std::ios::binary);
  truth_.open(draft_.path() / "truth.csv", std::ios::binary);
  times_ << "timestamp_ns,frame,file\n";
  write_label_header(labels_);
  truth_ << kTruthHeader;
}

std::string FlightWriter::name_of(FrameIndex frame) const { return fmt::format("{:06}{}", frame, suffix_); }

void FlightWriter::write_picture(FrameIndex frame, const std::vector<unsigned char>& bytes) const {
  write_bytes(draft_.path() / "images" / name_of(frame), bytes);
}

void FlightWriter::add(const FlownFrame& frame) {
  times_ << fmt::format("{},{},{}\n", ns(frame.captured), frames_, name_of(frames_));
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    write_label_row(labels_, frames_, targets_[i], frame.truth[i].label);
    truth_ << truth_row(frames_, targets_[i], frame, frame.truth[i]);
  }
  ++frames_;
  check_tables();
}

void FlightWriter::check_tables() const {
  if (!times_ || !labels_ || !truth_)
    throw Error(fmt::format("tables in {} cannot be written; is the disk full?", draft_.path().string()));
}

void FlightWriter::finish(const Recording& recording, const std::string& plan,
                          const std::string& calibration) {
  const auto write_beside = [&](const char* name, const std::string& text) {
    write_bytes(draft_.path() / name, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  };
  write_beside("flight.toml", plan);
  write_beside("camera.yaml", calibration);
  times_.flush(), labels_.flush(), truth_.flush();
  check_tables();
  write_description(draft_.path(), recording);
  draft_.put_in_place();
}

}  // namespace relock::simulator
