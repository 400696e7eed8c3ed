#include "cli/reproduce/report.h"

#include <fmt/format.h>

#include "cli/reproduce/folder.h"
#include "cli/terminal.h"
#include "cli/version.h"

namespace relock::reproduction {
namespace {

constexpr std::size_t kWidth = 110;  // columns of sentences
constexpr std::string_view kQuick = "QUICK";

/// "Figure 11" of "figure-11".
std::string spoken(std::string id) {
  if (id.empty()) return id;
  id.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(id.front())));
  std::replace(id.begin(), id.end(), '-', ' ');
  return id;
}

/// "Figure 11 QUICK: rings by code", of a title with or without the figure's name.
std::string marked_title(const std::string& id, const std::string& title, const Settings& settings) {
  const std::string name = spoken(id);
  std::string rest = title.starts_with(name) ? title.substr(name.size()) : ": " + title;
  const bool mark = settings.quick && rest.find(kQuick) == std::string::npos;
  return fmt::format("{}{}{}", name, mark ? fmt::format(" {}", kQuick) : "", rest);
}

/// A sentence in lines of kWidth, the first two spaces in and the rest four.
std::string in_lines(const std::string& sentence) {
  std::string text = "  ", word;
  std::size_t column = 2;
  const auto put = [&] {
    const std::size_t width = columns_of(word);
    if (column + width > kWidth && column > 4) {
      text.back() = '\n';
      text += "    ";
      column = 4;
    }
    text += word + " ";
    column += width + 1;
    word.clear();
  };
  for (const char c : sentence) c == ' ' ? put() : word.push_back(c);
  put();
  text.back() = '\n';
  return text;
}

}  // namespace

void mark_quick(std::vector<Finding>& findings, const Settings& settings) {
  for (Finding& finding : findings) {
    finding.title = marked_title(finding.id, finding.title, settings);
    if (!settings.quick) continue;
    for (auto& plot : finding.plots)
      std::visit(
          [](auto& p) {
            if (p.title.find(kQuick) == std::string::npos) p.title = fmt::format("{}: {}", kQuick, p.title);
          },
          plot);
  }
}

std::vector<std::vector<std::filesystem::path>> write_plots(const std::vector<Finding>& findings,
                                                            const Settings& settings) {
  const bool can = can_plot();
  std::vector<std::vector<std::filesystem::path>> files;
  for (const Finding& finding : findings) {
    files.push_back(finding.pictures);
    for (std::size_t n = 0; can && n < finding.plots.size(); ++n)
      for (const char* ending : {".svg", ".pdf", ".png"}) {
        files.back().push_back(file_of(settings, finding.id, n, ending));
        std::visit([&](const auto& plot) { draw(plot, files.back().back()); }, finding.plots[n]);
      }
  }
  return files;
}

std::string text_of(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& finding : findings) {
    text += (text.empty() ? "" : "\n") + finding.title + "\n";
    for (const Table& table : finding.tables) text += "\n" + table.text(2);
    if (!finding.sentences.empty()) text += "\n";
    for (const std::string& sentence : finding.sentences) text += in_lines(sentence);
  }
  return text;
}

std::string json_of(const std::vector<Finding>& findings,
                    const std::vector<std::vector<std::filesystem::path>>& files, const Settings& settings) {
  Json all = Json::array();
  for (std::size_t i = 0; i < findings.size(); ++i) {
    Json names = Json::array();
    for (const auto& file : files[i]) names.push_back(file.lexically_relative(settings.out).string());
    all.push_back({{"id", findings[i].id},
                   {"title", findings[i].title},
                   {"sentences", findings[i].sentences},
                   {"files", names},
                   {"figures", findings[i].figures}});
  }
  return json_text({{"relock", kVersion}, {"quick", settings.quick}, {"findings", all}});
}

}  // namespace relock::reproduction
