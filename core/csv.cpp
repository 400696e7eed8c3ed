#include "core/csv.h"

#include <csv.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.h"
#include "core/nearest.h"

namespace relock {
namespace {

/// libcsv's parser for one record at a time, freed when it goes.
class Tokenizer {
 public:
  explicit Tokenizer(std::vector<std::string>& cells) : cells_(cells) {
    if (csv_init(&parser_, CSV_STRICT | CSV_STRICT_FINI) != 0) throw std::bad_alloc();
  }
  ~Tokenizer() { csv_free(&parser_); }
  Tokenizer(const Tokenizer&) = delete;
  Tokenizer& operator=(const Tokenizer&) = delete;

  bool parse(const std::string& record) {
    const auto keep = [](void* cell, std::size_t size, void* self) {
      auto& all = static_cast<Tokenizer*>(self)->cells_;
      all.emplace_back(static_cast<const char*>(cell), size);
    };
    return csv_parse(&parser_, record.data(), record.size(), keep, nullptr, this) == record.size() &&
           csv_fini(&parser_, keep, nullptr, this) == 0;
  }

 private:
  csv_parser parser_{};
  std::vector<std::string>& cells_;
};

}  // namespace

std::string csv_cell(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string cell = "\"";
  for (const char c : text) {
    if (c == '"') cell += c;
    cell += c;
  }
  return cell + "\"";
}

CsvReader::CsvReader(std::istream& in, std::string name) : in_(in), name_(std::move(name)) {
  if (!read_record(header_)) throw Error(fmt::format("{}: the file is empty; it needs a header line", name_));
  for (auto cell = header_.begin(); cell != header_.end(); ++cell)
    if (std::find(header_.begin(), cell, *cell) != cell)
      fail(fmt::format("two columns are called \"{}\"", *cell));
}

void CsvReader::expect_only(std::span<const std::string> known) const {
  for (const std::string& name : header_)
    if (std::find(known.begin(), known.end(), name) == known.end())
      fail(fmt::format("no column is called \"{}\"{}", name, did_you_mean(name, known)));
}

CsvReader::Column CsvReader::optional_column(std::string_view name) const {
  const auto at = std::find(header_.begin(), header_.end(), name);
  return at == header_.end() ? missing : static_cast<Column>(at - header_.begin());
}

CsvReader::Column CsvReader::column(std::string_view name) const {
  const Column found = optional_column(name);
  if (found == missing) {
    const std::string wanted[] = {std::string(name)};
    const auto near = std::find_if(header_.begin(), header_.end(),
                                   [&](const std::string& h) { return !nearest_name(h, wanted).empty(); });
    fail(fmt::format("the column \"{}\" is missing{}", name,
                     near == header_.end() ? "" : fmt::format(" (is it the one called \"{}\"?)", *near)));
  }
  return found;
}

bool CsvReader::next() {
  if (!read_record(row_)) return false;
  if (row_.size() != header_.size())
    fail(fmt::format("this line has {} cells and the header has {}", row_.size(), header_.size()));
  return true;
}

bool CsvReader::read_record(std::vector<std::string>& cells) {
  do {
    if (!std::getline(in_, buffer_)) return false;
    ++line_;
    if (!buffer_.empty() && buffer_.back() == '\r') buffer_.pop_back();
  } while (buffer_.empty());
  if (line_ == 1 && buffer_.starts_with("\xEF\xBB\xBF")) buffer_.erase(0, 3);  // a byte order mark
  cells.clear();
  if (!Tokenizer(cells).parse(buffer_)) fail("a quote is open or misplaced");
  return true;
}

std::string_view CsvReader::text(Column column) const {
  return column == missing ? std::string_view{} : std::string_view(row_[column]);
}

std::optional<double> CsvReader::optional_number(Column column) const {
  const std::string_view cell = text(column);
  if (cell.empty()) return {};
  double value = 0;
  const auto [end, fault] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (fault != std::errc{} || end != cell.data() + cell.size() || !std::isfinite(value))
    fail(fmt::format("column {}: \"{}\" is no finite number", header_[column], cell));
  return value;
}

double CsvReader::number(Column column) const {
  const auto value = optional_number(column);
  if (!value) fail(fmt::format("column {}: a number is missing", header_[column]));
  return *value;
}

std::int64_t CsvReader::whole(Column column) const {
  const std::string_view cell = text(column);
  std::int64_t value = 0;
  const auto [end, fault] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (cell.empty() || fault != std::errc{} || end != cell.data() + cell.size())
    fail(fmt::format("column {}: \"{}\" is no whole number", header_[column], cell));
  return value;
}

void CsvReader::fail(std::string_view sentence) const { throw Error::at(name_, line_, sentence); }

}  // namespace relock
