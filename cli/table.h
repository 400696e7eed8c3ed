#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace relock {

/// A number as a cell; "n/a" where there is none.
std::string cell(const std::optional<double>& value, int decimals);

/// Likewise with its sign; what rounds to nothing has none.
std::string signed_cell(const std::optional<double>& value, int decimals);

/// How a table is written.
enum class TableFormat : std::uint8_t { text, markdown, latex };

/// A table: the first column flush left, the others flush right.
class Table {
 public:
  explicit Table(std::vector<std::string> header) { rows_.push_back(std::move(header)); }
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  /// Two spaces between columns; every line indented by `indent` spaces and ended.
  std::string text(std::size_t indent) const;
  /// As `format` has it; text is indented by two. LaTeX is a tabular with the rules of booktabs.
  std::string in(TableFormat format) const;

 private:
  std::string markdown() const;
  std::string latex() const;

  std::vector<std::vector<std::string>> rows_;
};

}  // namespace relock
