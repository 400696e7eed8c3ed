// `relock new`: a plug-in to start from, which builds, loads and does something as it is.

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "cli/catalogue.h"
#include "cli/files.h"
#include "cli/plugins/template.h"
#include "cli/verbs.h"
#include "core/error.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

/// Names of CMake's own targets, and of relock's.
const std::set<std::string> kTaken{
    "all",     "clean",  "edit_cache",    "help",   "install", "list_install_components",
    "package", "plugin", "rebuild_cache", "relock", "test"};

void check_name(const std::string& name, const Methods& methods) {
  bool legal = !name.empty() && name.size() <= 40 && std::islower(static_cast<unsigned char>(name[0])) &&
               name.back() != '_' && name.find("__") == std::string::npos;
  for (const char c : name) legal = legal && ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_');
  if (!legal)
    throw Error(
        fmt::format("\"{}\" is no name for a method; write lower case letters, digits and single _, as in "
                    "my_method",
                    name));
  const auto names = method_names(methods);
  if (kTaken.contains(name) || std::find(names.begin(), names.end(), name) != names.end())
    throw Error(fmt::format("the name \"{}\" is taken; choose another", name));
}

/// "MyMethod" of "my_method".
std::string class_name(const std::string& name) {
  std::string camel;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] == '_') continue;
    const bool first = i == 0 || name[i - 1] == '_';
    camel += first ? static_cast<char>(std::toupper(static_cast<unsigned char>(name[i]))) : name[i];
  }
  return camel;
}

std::string replaced(std::string text, std::string_view from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

std::string indented(std::string_view lines) {
  std::string text;
  for (std::size_t at = 0; at < lines.size();) {
    const std::size_t end = std::min(lines.find('\n', at), lines.size());
    text += fmt::format("    {}\n", lines.substr(at, end - at));
    at = end + 1;
  }
  return text;
}

std::string readme(const NewArguments& arguments, std::string_view commands) {
  return fmt::format(
      "# {0}\n\nA {1} for relock. Build it, see whether it is there and keeps what a {1} promises, and run "
      "it:\n\n"
      "{2}\n`ctest --test-dir build` does the last two as tests. Copied to ~/.local/share/relock/plugins, it "
      "is\n"
      "there without --plugin.\n",
      arguments.name, arguments.kind, indented(commands));
}

}  // namespace

int start_new(const NewArguments& arguments, const Methods& methods) {
  if (arguments.kind != "detector" && arguments.kind != "tracker")
    throw Error(fmt::format("there is no \"{}\" to begin; write detector or tracker", arguments.kind));
  check_name(arguments.name, methods);
  const fs::path folder = arguments.in / arguments.name;
  if (fs::exists(fs::symlink_status(folder)))
    throw Error(
        fmt::format("{} is there already, and nothing in it is overwritten; choose another name or --in",
                    folder.string()));
  const PluginTemplate& t = arguments.kind == "detector" ? kDetectorTemplate : kTrackerTemplate;
  const auto own = [&](std::string_view text) {
    return replaced(replaced(std::string(text), t.name, arguments.name), t.class_name,
                    class_name(arguments.name));
  };
  std::error_code fault;
  fs::create_directories(folder, fault);
  if (fault) throw Error(fmt::format("{} cannot be made ({})", folder.string(), fault.message()));
  write_file(folder / (arguments.name + ".cpp"), own(t.source));
  write_file(folder / "CMakeLists.txt", own(t.cmake));
  const std::string commands = own(t.commands);
  write_file(folder / "README.md", readme(arguments, commands));
  fmt::print("{} is a {} that works; make it yours:\n\n    cd {}\n{}", folder.string(), arguments.kind,
             folder.string(), indented(commands));
  return 0;
}

}  // namespace relock
