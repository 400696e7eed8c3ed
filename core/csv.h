#pragma once

#include <cstdint>
#include <istream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace relock {

/// A text as a CSV cell: quoted where it has to be.
std::string csv_cell(std::string_view text);

/// Reads a CSV (RFC 4180, one record a line) with a header line, row by row, columns by name. Every fault is
/// an Error that names file, line and column. Numbers are read without regard to the locale.
///
///     CsvReader rows(file, "labels.csv");
///     const auto x = rows.column("x");                 // throws if there is none
///     while (rows.next()) use(rows.number(x));
class CsvReader {
 public:
  /// A column's place; `missing` for an optional one that the file does not have.
  using Column = std::size_t;
  static constexpr Column missing = static_cast<Column>(-1);

  /// Reads the header. `name` is what errors call the file.
  CsvReader(std::istream& in, std::string name);

  const std::vector<std::string>& header() const { return header_; }
  /// Throws Error when the header has a column that is not among `known` (nearest name offered).
  void expect_only(std::span<const std::string> known) const;
  Column column(std::string_view name) const;
  Column optional_column(std::string_view name) const;

  /// Moves on to the next row; false at the end. Throws Error on a row of another length than the header.
  bool next();
  std::size_t line() const { return line_; }

  /// The cell as it stands; empty for a missing column.
  std::string_view text(Column column) const;
  /// Nothing for an empty cell. Throws Error on anything but a finite number.
  std::optional<double> optional_number(Column column) const;
  double number(Column column) const;
  std::int64_t whole(Column column) const;

  /// An Error at the current line.
  [[noreturn]] void fail(std::string_view sentence) const;

 private:
  bool read_record(std::vector<std::string>& cells);

  std::istream& in_;
  std::string name_;
  std::vector<std::string> header_;
  std::vector<std::string> row_;
  std::string buffer_;
  std::size_t line_ = 0;
};

}  // namespace relock
