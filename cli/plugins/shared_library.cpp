#include "cli/plugins/shared_library.h"

#include <fmt/format.h>

#include <dlfcn.h>
#include <elf.h>
#include <link.h>

#include <cstring>
#include <exception>
#include <fstream>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/error.h"

namespace relock {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kOpenCvCore = "libopencv_core.so.";

/// An ELF file, read piece by piece: a plug-in may carry a network of many megabytes.
class ElfFile {
 public:
  explicit ElfFile(const fs::path& path) : in_(path, std::ios::binary) {}

  template <class Piece>
  std::optional<Piece> at(std::uint64_t offset) {
    Piece piece;
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(offset));
    if (!in_.read(reinterpret_cast<char*>(&piece), sizeof piece)) return {};
    return piece;
  }

  std::string text_at(std::uint64_t offset) {
    std::string text;
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(offset));
    for (char c = 0; text.size() < 4096 && in_.get(c) && c != '\0';) text += c;
    return text;
  }

 private:
  std::ifstream in_;
};

using Header = ElfW(Ehdr);
using Segment = ElfW(Phdr);
using Dynamic = ElfW(Dyn);

std::vector<Segment> segments_of(ElfFile& elf, const Header& header) {
  std::vector<Segment> segments;
  for (std::uint64_t i = 0; i < header.e_phnum; ++i)
    if (const auto segment = elf.at<Segment>(header.e_phoff + i * header.e_phentsize))
      segments.push_back(*segment);
  return segments;
}

/// Where in the file an address of the loaded library comes from.
std::uint64_t file_offset(const std::vector<Segment>& segments, std::uint64_t address) {
  for (const Segment& s : segments)
    if (s.p_type == PT_LOAD && address >= s.p_vaddr && address - s.p_vaddr < s.p_filesz)
      return s.p_offset + (address - s.p_vaddr);
  return 0;
}

/// Names of the libraries that this one asks for. A damaged file gives none: loading it will say more.
std::vector<std::string> needed_by(ElfFile& elf, const Header& header) {
  const auto segments = segments_of(elf, header);
  std::vector<std::uint64_t> names;
  std::uint64_t strings = 0;
  for (const Segment& s : segments) {
    if (s.p_type != PT_DYNAMIC) continue;
    for (std::uint64_t at = 0; at < s.p_filesz; at += sizeof(Dynamic)) {
      const auto entry = elf.at<Dynamic>(s.p_offset + at);
      if (!entry || entry->d_tag == DT_NULL) break;
      if (entry->d_tag == DT_NEEDED) names.push_back(entry->d_un.d_val);
      if (entry->d_tag == DT_STRTAB) strings = file_offset(segments, entry->d_un.d_ptr);
    }
  }
  std::vector<std::string> needed;
  for (const std::uint64_t name : names) needed.push_back(elf.text_at(strings + name));
  return needed;
}

/// Names of all OpenCV cores in this process; one, if all is well.
std::set<std::string> loaded_opencv_cores() {
  std::set<std::string> cores;
  dl_iterate_phdr(
      [](dl_phdr_info* library, std::size_t, void* found) {
        std::string name = fs::path(library->dlpi_name).filename().string();
        // Loaded by its real name or by a link to it: libopencv_core.so.4.6.0 is libopencv_core.so.406.
        std::error_code ignored;
        const auto real = fs::canonical(library->dlpi_name, ignored).filename().string();
        if (name.starts_with(kOpenCvCore) || real.starts_with(kOpenCvCore))
          static_cast<std::set<std::string>*>(found)->insert(name);
        return 0;
      },
      &cores);
  return cores;
}

/// "406" of "libopencv_video.so.406"; empty when it is no library of OpenCV.
std::string opencv_version_in(const std::string& name) {
  const std::size_t at = name.find(".so.");
  return name.starts_with("libopencv_") && at != std::string::npos ? name.substr(at + 4) : "";
}

std::string two_opencv(const std::string& theirs, const std::string& ours) {
  return fmt::format(
      "it was built against another OpenCV ({}) than this relock ({}); build it against that one", theirs,
      ours);
}

void check_opencv(const std::vector<std::string>& needed) {
  const auto loaded = loaded_opencv_cores();
  if (loaded.empty()) return;
  const std::string& ours = *loaded.begin();
  for (const std::string& name : needed) {
    const std::string version = opencv_version_in(name);
    if (!version.empty() && version != opencv_version_in(ours)) throw Error(two_opencv(name, ours));
  }
}

/// dlerror begins with the file's name, which is said already.
std::string loader_fault(const fs::path& file) {
  const char* said = dlerror();
  std::string text = said ? said : "no reason is given";
  const std::string name = file.string() + ": ";
  return text.starts_with(name) ? text.substr(name.size()) : text;
}

/// What other people's code does, with whatever it throws turned into an Error. C code is not expected to
/// throw, and yet.
template <class Act>
auto caught(const char* when, Act act) {
  try {
    return act();
  } catch (const std::exception& fault) {
    throw Error(fmt::format("it throws {} ({})", when, fault.what()));
  } catch (...) {
    throw Error(fmt::format("it throws {}", when));
  }
}

}  // namespace

void check_shared_library(const fs::path& file) {
  if (!fs::exists(file)) throw Error("it does not exist");
  if (!fs::is_regular_file(file)) throw Error("it is no file");
  ElfFile elf(file), own("/proc/self/exe");
  const auto header = elf.at<Header>(0), our_header = own.at<Header>(0);
  if (!header || std::memcmp(header->e_ident, ELFMAG, SELFMAG) != 0)
    throw Error("it is no shared library, or cannot be read");
  if (our_header && (header->e_ident[EI_CLASS] != our_header->e_ident[EI_CLASS] ||
                     header->e_machine != our_header->e_machine))
    throw Error("it was built for another kind of processor");
  if (header->e_type != ET_DYN) throw Error("it is no shared library; link it with -shared");
  check_opencv(needed_by(elf, *header));
}

const relock_plugin* load_plugin(const fs::path& file) {
  const fs::path whole = fs::absolute(file);  // a bare name would be looked for in the system's folders
  // Now, so that a missing function is told here and not in the middle of a run.
  void* library = caught("when it is loaded", [&] { return dlopen(whole.c_str(), RTLD_NOW | RTLD_LOCAL); });
  if (!library) throw Error(fmt::format("it cannot be loaded ({})", loader_fault(whole)));
  const auto cores = loaded_opencv_cores();
  if (cores.size() > 1) throw Error(two_opencv(*cores.rbegin(), *cores.begin()));
  using Entry = const relock_plugin* (*)(std::uint32_t);
  const auto entry = reinterpret_cast<Entry>(dlsym(library, "relock_plugin_v1"));
  if (!entry) throw Error("it is no relock plug-in: it has no function relock_plugin_v1");
  return caught("when it is asked for its methods", [&] { return entry(RELOCK_PLUGIN_ABI); });
}

}  // namespace relock
