#include "cli/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "cli/terminal.h"

namespace relock {
namespace {

/// Spaces that align cells in text say nothing elsewhere.
std::string_view trimmed(std::string_view cell) { return cell.substr(0, cell.find_last_not_of(' ') + 1); }

std::string in_markdown(const std::string& cell) {
  std::string text;
  for (const char c : trimmed(cell)) {
    if (std::string_view("|*_<`\\").find(c) != std::string_view::npos) text += '\\';
    text += c;
  }
  return text;
}

std::string in_latex(char c) {
  switch (c) {
    case '<':
    case '>':
    case '|':
      return fmt::format("${}$", c);
    case '\\':
      return "\\textbackslash{}";
    case '^':
      return "\\textasciicircum{}";
    case '~':
      return "\\textasciitilde{}";
    default:
      break;
  }
  const bool special = std::string_view("&%$#_{}").find(c) != std::string_view::npos;
  return special ? fmt::format("\\{}", c) : std::string(1, c);
}

std::string in_latex(const std::string& cell) {
  std::string text;
  for (const char c : trimmed(cell)) text += in_latex(c);
  return text;
}

}  // namespace

std::string cell(const std::optional<double>& value, int decimals) {
  return value ? fmt::format("{:.{}f}", *value, decimals) : "n/a";
}

std::string signed_cell(const std::optional<double>& value, int decimals) {
  if (!value) return "n/a";
  const std::string text = fmt::format("{:+.{}f}", *value, decimals);
  return text.find_first_of("123456789") == std::string::npos ? text.substr(1) : text;
}

std::string Table::text(std::size_t indent) const {
  std::vector<std::size_t> widths(rows_.front().size());
  for (const auto& row : rows_)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], columns_of(row[i]));
  std::string text;
  for (const auto& row : rows_) {
    std::string line(indent, ' ');
    for (std::size_t i = 0; i < row.size(); ++i)
      line += i == 0 ? padded(row[i], widths[i]) : "  " + right_aligned(row[i], widths[i]);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string Table::markdown() const {
  std::string text;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    for (const std::string& cell : rows_[r]) text += fmt::format("| {} ", in_markdown(cell));
    text += "|\n";
    if (r > 0) continue;
    for (std::size_t i = 0; i < rows_[r].size(); ++i) text += i == 0 ? "|---" : "|---:";
    text += "|\n";
  }
  return text;
}

std::string Table::latex() const {
  std::string text =
      fmt::format("\\begin{{tabular}}{{l{}}}\n\\toprule\n", std::string(rows_.front().size() - 1, 'r'));
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    for (std::size_t i = 0; i < rows_[r].size(); ++i)
      text += fmt::format("{}{}", i == 0 ? "" : " & ", in_latex(rows_[r][i]));
    text += r == 0 ? " \\\\\n\\midrule\n" : " \\\\\n";
  }
  return text + "\\bottomrule\n\\end{tabular}\n";
}

std::string Table::in(TableFormat format) const {
  switch (format) {
    case TableFormat::markdown:
      return markdown();
    case TableFormat::latex:
      return latex();
    case TableFormat::text:
      break;
  }
  return text(2);
}

}  // namespace relock
