#include "cli/reproduce/canvas_answers.h"

#include <fmt/format.h>

#include <array>
#include <sstream>

#include "cli/files.h"
#include "core/csv.h"
#include "core/error.h"

namespace relock::reproduction {
namespace {

constexpr std::array kVerdictsOfPictures{Verdict::Hit, Verdict::WrongId, Verdict::Stray, Verdict::Miss};

/// Hundredths of a percent of a pixel, and the same on every machine.
std::string cell(const std::optional<double>& value) {
  if (!value) return "";
  const std::string text = fmt::format("{:.4f}", *value);
  return text == "-0.0000" ? "0.0000" : text;
}

Verdict verdict_of(const CsvReader& rows, CsvReader::Column column) {
  for (const Verdict verdict : kVerdictsOfPictures)
    if (rows.text(column) == to_string(verdict)) return verdict;
  rows.fail(fmt::format("\"{}\" is no verdict on a picture", rows.text(column)));
}

}  // namespace

std::string answers_text(const std::string& made_by, const std::vector<PictureAnswer>& answers) {
  std::string text =
      fmt::format("# {}\nblur_px,angle_deg,verdict,uncoded,error_px,along_px,across_px,spurious\n", made_by);
  for (const PictureAnswer& a : answers)
    text += fmt::format("{:g},{:g},{},{},{},{},{},{}\n", a.blur_px, a.angle_deg, to_string(a.verdict),
                        a.uncoded ? 1 : 0, cell(a.error_px), cell(a.along_px), cell(a.across_px), a.spurious);
  return text;
}

std::optional<std::vector<PictureAnswer>> read_answers(const std::filesystem::path& file,
                                                       const std::string& made_by, std::size_t pictures) {
  if (!std::filesystem::exists(file)) return {};
  std::istringstream text(read_file(file));
  std::string first;
  std::getline(text, first);
  if (first != "# " + made_by) return {};
  CsvReader rows(text, file.string());
  const auto blur = rows.column("blur_px"), angle = rows.column("angle_deg"),
             verdict = rows.column("verdict"), uncoded = rows.column("uncoded"),
             error = rows.column("error_px"), along = rows.column("along_px"),
             across = rows.column("across_px"), spurious = rows.column("spurious");
  std::vector<PictureAnswer> answers;
  while (rows.next())
    answers.push_back({rows.number(blur), rows.number(angle), verdict_of(rows, verdict),
                       rows.whole(uncoded) != 0, rows.optional_number(error), rows.optional_number(along),
                       rows.optional_number(across), static_cast<int>(rows.whole(spurious))});
  if (answers.size() != pictures)
    throw Error(fmt::format("{} has {} rows for {} pictures; remove it, and it is made again", file.string(),
                            answers.size(), pictures));
  return answers;
}

}  // namespace relock::reproduction
