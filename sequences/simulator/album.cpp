#include "sequences/simulator/album.h"

#include <fmt/format.h>

#include <cstdint>

#include "core/recording.h"
#include "sequences/open.h"
#include "sequences/simulator/draft.h"
#include "sequences/simulator/transport.h"

namespace relock::simulator {

namespace fs = std::filesystem;

void write_album(const fs::path& folder, const Album& album) {
  constexpr double kRate_hz = 30;
  Draft draft(folder);
  make_folder(draft.path() / "images");
  Recording recording;
  recording.name = folder_name(folder);
  recording.picture = album.picture;
  recording.period = period_of(kRate_hz);
  recording.targets = album.targets;
  std::vector<std::uint8_t> bytes;
  for (std::size_t rank = 0; rank < album.pages; ++rank) {
    const AlbumPage page = album.page(rank);
    encode_picture(page.pixels, {.jpeg_quality = 0}, bytes);
    write_bytes(draft.path() / "images" / fmt::format("{:06}.png", rank), bytes);
    recording.captured.push_back(Time{from_seconds(static_cast<double>(rank) / kRate_hz)});
    recording.truth.insert(recording.truth.end(), page.truth.begin(), page.truth.end());
  }
  write_truth(draft.path(), recording);
  const auto write_beside = [&](const std::string& name, const std::string& text) {
    if (!text.empty())
      write_bytes(draft.path() / name, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  };
  write_beside(album.plan_name, album.plan_text);
  write_beside("camera.yaml", album.calibration_text);
  draft.put_in_place();
}

}  // namespace relock::simulator
