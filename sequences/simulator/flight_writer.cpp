#include "sequences/simulator/flight_writer.h"

#include <fmt/format.h>
#include <unistd.h>

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

FlightWriter::FlightWriter(fs::path out, std::vector<Target> targets, std::string picture_ending)
    : out_(std::move(out)), targets_(std::move(targets)), ending_(std::move(picture_ending)) {
  if (out_.filename().empty()) out_ = out_.parent_path();  // "flight/"
  if (out_.empty()) throw Error("a flight needs a folder to be written to");
  if (fs::exists(out_))
    throw Error(fmt::format("{} is there already; choose another folder or remove it", out_.string()));
  draft_ = out_.parent_path() / fmt::format(".{}.tmp.{}", out_.filename().string(), getpid());
  std::error_code fault;
  fs::remove_all(draft_, fault);
  fs::create_directories(draft_ / "images", fault);
  if (fault) throw Error(fmt::format("{} cannot be made ({})", out_.string(), fault.message()));
  times_.open(draft_ / "timestamps.csv", std::ios::binary);
  labels_.open(draft_ / "labels.csv", std::ios::binary);
  truth_.open(draft_ / "truth.csv", std::ios::binary);
  times_ << "timestamp_ns,frame,file\n";
  write_label_header(labels_);
  truth_ << kTruthHeader;
}

FlightWriter::~FlightWriter() {
  std::error_code ignored;
  if (!draft_.empty()) fs::remove_all(draft_, ignored);
}

std::string FlightWriter::name_of(FrameIndex frame) const { return fmt::format("{:06}{}", frame, ending_); }

void FlightWriter::fail(const fs::path& file) const {
  throw Error(fmt::format("{} cannot be written; is the disk full?", (out_ / file).string()));
}

void FlightWriter::write_picture(FrameIndex frame, const std::vector<unsigned char>& bytes) const {
  const fs::path file = fs::path("images") / name_of(frame);
  std::ofstream out(draft_ / file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) fail(file);
}

void FlightWriter::add(const FlownFrame& frame) {
  times_ << fmt::format("{},{},{}\n", ns(frame.captured), frames_, name_of(frames_));
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    write_label_row(labels_, frames_, targets_[i], frame.truth[i].label);
    truth_ << truth_row(frames_, targets_[i], frame, frame.truth[i]);
  }
  ++frames_;
  if (!times_ || !labels_ || !truth_) fail("labels.csv");
}

void FlightWriter::finish(const Recording& recording, const std::string& plan) {
  std::ofstream toml(draft_ / "flight.toml", std::ios::binary);
  toml << plan;
  if (!toml.flush()) fail("flight.toml");
  if (!times_.flush()) fail("timestamps.csv");
  if (!labels_.flush()) fail("labels.csv");
  if (!truth_.flush()) fail("truth.csv");
  write_description(draft_, recording);
  std::error_code fault;
  fs::rename(draft_, out_, fault);
  if (fault) throw Error(fmt::format("{} cannot be made ({})", out_.string(), fault.message()));
  draft_.clear();
}

}  // namespace relock::simulator
