#include "cli/benchmark_files.h"

#include <fmt/format.h>

#include <array>

#include "core/error.h"
#include "core/nearest.h"
#include "eval/compatibility/overlap.h"
#include "sequences/benchmark.h"
#include "sequences/vot_region.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

struct Name {
  ResultFormat format;
  std::string_view text;
};
constexpr std::array kNames{Name{ResultFormat::vot, "vot"}, Name{ResultFormat::otb, "otb"},
                            Name{ResultFormat::got10k, "got10k"}, Name{ResultFormat::tum, "tum"}};

std::string line_of(const Box& box) {
  return fmt::format("{:.4f},{:.4f},{:.4f},{:.4f}", box.x, box.y, box.width, box.height);
}

std::string line_of(const Quad& quad) {
  std::string line;
  for (const Vec2& corner : quad.corner)
    line += fmt::format("{}{:.4f},{:.4f}", line.empty() ? "" : ",", corner.x, corner.y);
  return line;
}

std::string vot_line(VotCode code, const std::optional<Outline>& answer) {
  if (code == VotCode::nothing) return "0";
  if (code == VotCode::start) return "1";
  if (code == VotCode::failure || !answer) return "2";
  const Outline region = from_corner(*answer);
  if (const auto* quad = std::get_if<Quad>(&region)) return line_of(*quad);
  return line_of(std::get<Box>(region));
}

std::string box_line(const std::optional<Outline>& answer) {
  return answer ? line_of(one_based(bounds(*answer))) : "0,0,0,0";
}

std::string tum_line(Time captured, const Outline& outline) {
  const Vec2 centre = centre_of(outline);
  return fmt::format("{}.{:09d} {:.4f} {:.4f} 0 0 0 0 1\n", ns(captured) / 1'000'000'000,
                     ns(captured) % 1'000'000'000, centre.x, centre.y);
}

std::string tum_answers(const AnsweredSequence& sequence, const Recording& recording) {
  std::string text;
  for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
    const AnsweredFrame& frame = sequence.frames[i];
    if (frame.answer && !frame.given)
      text += tum_line(recording.captured[sequence.first_frame + i], *frame.answer);
  }
  return text;
}

/// "0", "1" or "2" alone on a line.
std::optional<VotCode> code_of(std::string_view line, const std::string& file, std::size_t number) {
  if (line.starts_with('m') || line.find(',') != std::string_view::npos) return {};
  const auto cells = numbers_of(line, file, number);
  if (cells.size() != 1) return {};
  if (cells[0] == 0) return VotCode::nothing;
  if (cells[0] == 1) return VotCode::start;
  if (cells[0] == 2) return VotCode::failure;
  throw Error::at(file, number,
                  fmt::format("{} is no code; they are 0 (nothing), 1 (start), 2 (failure)", line));
}

std::vector<ForeignAnswer> read_vot(const fs::path& file) {
  std::vector<ForeignAnswer> answers;
  const auto lines = lines_of(file);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (const auto code = code_of(lines[i], file.string(), i + 1)) {
      answers.push_back({*code, {}});
    } else {
      answers.push_back({VotCode::region, vot_region(lines[i], file.string(), i + 1)});
    }
  }
  return answers;
}

}  // namespace

std::string_view to_string(ResultFormat format) {
  for (const Name& name : kNames)
    if (name.format == format) return name.text;
  return {};
}

ResultFormat parse_result_format(std::string_view text) {
  std::vector<std::string> known;
  for (const Name& name : kNames) {
    if (name.text == text) return name.format;
    known.emplace_back(name.text);
  }
  throw Error(fmt::format("results are not known as \"{}\"{}; they are vot, otb, got10k or tum", text,
                          did_you_mean(std::string(text), known)));
}

bool fits(ResultFormat format, Protocol protocol) {
  const std::string_view name = to_string(protocol);
  if (format == ResultFormat::vot) return name == "vot";
  if (format == ResultFormat::tum) return name != "multistart";
  return name == "once" || name == "detect";
}

fs::path result_path(ResultFormat format, const std::string& method, const std::string& sequence) {
  const fs::path folder = method;
  if (format == ResultFormat::got10k) return folder / sequence / (sequence + "_001.txt");
  if (format == ResultFormat::vot) return folder / "baseline" / sequence / (sequence + "_001.txt");
  return folder / (sequence + ".txt");
}

std::optional<fs::path> times_path(ResultFormat format, const std::string& method,
                                   const std::string& sequence) {
  const fs::path folder = result_path(format, method, sequence).parent_path();
  switch (format) {
    case ResultFormat::otb:
      return folder / "times" / (sequence + "_time.txt");
    case ResultFormat::got10k:
      return folder / (sequence + "_time.txt");
    case ResultFormat::vot:
      return folder / (sequence + "_001_time.value");
    case ResultFormat::tum:
      break;
  }
  return {};
}

std::string result_text(ResultFormat format, const AnsweredSequence& sequence, const Recording& recording) {
  if (format == ResultFormat::tum) return tum_answers(sequence, recording);
  const bool vot = format == ResultFormat::vot;
  const std::vector<VotCode> codes = vot ? vot_codes(sequence) : std::vector<VotCode>{};
  std::string text;
  for (std::size_t i = 0; i < sequence.first_frame; ++i)
    text += (vot ? vot_line(VotCode::nothing, {}) : box_line({})) + "\n";
  for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
    const AnsweredFrame& frame = sequence.frames[i];
    text += (vot ? vot_line(codes[i], frame.answer) : box_line(i == 0 ? frame.truth : frame.answer)) + "\n";
  }
  return text;
}

std::string tum_truth(const AnsweredSequence& sequence, const Recording& recording) {
  std::string text;
  for (std::size_t i = 0; i < sequence.frames.size(); ++i)
    if (const auto& truth = sequence.frames[i].truth)
      text += tum_line(recording.captured[sequence.first_frame + i], *truth);
  return text;
}

std::vector<ForeignAnswer> read_answers(ResultFormat format, const fs::path& file) {
  if (format == ResultFormat::tum)
    throw Error(fmt::format(
        "{}: a path of centres has no boxes and cannot be imported; use vot, otb or got10k", file.string()));
  if (format == ResultFormat::vot) return read_vot(file);
  std::vector<ForeignAnswer> answers;
  for (auto& outline : read_boxes(file, Origin::one))
    answers.push_back({VotCode::region, std::move(outline)});
  return answers;
}

}  // namespace relock
