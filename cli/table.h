#pragma once

#include <string>
#include <vector>

namespace relock {

/// A table of text: the first column flush left, the others flush right, two spaces between.
class Table {
 public:
  explicit Table(std::vector<std::string> header) { rows_.push_back(std::move(header)); }
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  /// Every line indented by `indent` spaces and ended.
  std::string text(std::size_t indent) const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace relock
