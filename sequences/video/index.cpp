#include "sequences/video/index.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <set>

#include "core/error.h"
#include "sequences/video/decoder.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

namespace relock {
namespace {

/// Whether each packet of the coding is one picture to be shown, and each such picture one packet.
bool one_picture_a_packet(const AVCodecParameters& coded) {
  if (coded.field_order != AV_FIELD_PROGRESSIVE && coded.field_order != AV_FIELD_UNKNOWN) return false;
  switch (coded.codec_id) {
    case AV_CODEC_ID_H264:
    case AV_CODEC_ID_HEVC:
    case AV_CODEC_ID_VP9:
    case AV_CODEC_ID_AV1:
      return true;
    default:
      break;
  }
  const AVCodecDescriptor* descriptor = avcodec_descriptor_get(coded.codec_id);
  return descriptor && (descriptor->props & AV_CODEC_PROP_INTRA_ONLY) != 0;
}

/// Whether the file ends long before the end that its header states.
bool ends_early(const VideoFile& file, std::int64_t end_ns) {
  constexpr std::int64_t one_second = 1'000'000'000;
  const auto stated = file.stated_end_ns();
  return stated && *stated - end_ns > one_second;
}

/// The presentation times of all packets in rising order; nothing where they may not be those of the frames.
std::optional<VideoIndex> index_of_packets(const std::filesystem::path& path) {
  constexpr std::int64_t kMostReordering = 16;  // frames; what comes later than that has another clock
  VideoFile file(path);
  if (!file.keeps_times() || !one_picture_a_packet(*file.stream().codecpar)) return {};
  VideoIndex index;
  std::int64_t end = std::numeric_limits<std::int64_t>::min();
  while (const AVPacket* packet = file.read()) {
    if ((packet->flags & AV_PKT_FLAG_DISCARD) != 0) continue;  // an edit list has cut it out
    const bool first = index.keys.empty();
    if (packet->pts == AV_NOPTS_VALUE || (packet->flags & AV_PKT_FLAG_CORRUPT) != 0) return {};
    if (first ? (packet->flags & AV_PKT_FLAG_KEY) == 0 : packet->pts < index.keys.front()) return {};
    index.keys.push_back(packet->pts);
    end = std::max(end, packet->pts + packet->duration);
  }
  if (index.keys.empty()) return {};
  std::vector<std::int64_t> sorted = index.keys;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return {};
  for (std::size_t i = kMostReordering; i < sorted.size(); ++i)
    if (index.keys[i] < sorted[i - kMostReordering]) return {};
  index.keys = std::move(sorted);
  index.cut_off = file.cut_off() || ends_early(file, file.nanoseconds(end));
  if (index.cut_off) index.keys.push_back(std::max(end, index.keys.back() + 1));
  for (const std::int64_t ticks : index.keys) index.captured.push_back(time_ns(file.nanoseconds(ticks)));
  return index;
}

/// Why the frame's time cannot be its capture time, given the one before it.
std::string fault_of_time(const VideoFile& file, const DecodedFrame& frame,
                          std::optional<std::int64_t> before) {
  if (!file.keeps_times()) return "keeps no times";
  if (!frame.ticks) return fmt::format("keeps no presentation time of frame {}", frame.rank);
  if (!before || *before < *frame.ticks) return "";
  const auto in_seconds = [&](std::int64_t ticks) { return seconds(time_ns(file.nanoseconds(ticks))); };
  return fmt::format("has frame {} at {:.6f} s, which {} the one before it ({:.6f} s)", frame.rank,
                     in_seconds(*frame.ticks), *before == *frame.ticks ? "repeats" : "goes back behind",
                     in_seconds(*before));
}

VideoIndex index_of_frames(const std::filesystem::path& path) {
  VideoDecoder decoder(path);
  const VideoFile& file = decoder.file();
  VideoIndex index;
  std::set<std::int64_t> times;
  std::optional<std::int64_t> before;
  bool any = false;
  while (const auto frame = decoder.next()) {
    any = true;
    if (index.untimed.empty()) index.untimed = fault_of_time(file, *frame, before);
    if (!frame->ticks) continue;
    times.insert(*frame->ticks);
    before = frame->ticks;
  }
  if (!any) throw Error(fmt::format("{}: not one of its pictures can be decoded", file.name()));
  index.cut_off = file.cut_off();
  if (!index.untimed.empty()) {
    index.by_rank = true;
    for (std::int64_t rank = 0; rank < decoder.ranks(); ++rank) index.keys.push_back(rank);
    return index;
  }
  // What is lost before the first frame is how a stream begins that was joined in the middle.
  const std::int64_t first = *times.begin();
  times.insert(decoder.damaged().upper_bound(first), decoder.damaged().end());
  index.keys.assign(times.begin(), times.end());
  for (const std::int64_t ticks : index.keys) index.captured.push_back(time_ns(file.nanoseconds(ticks)));
  return index;
}

}  // namespace

VideoIndex index_video(const std::filesystem::path& path) {
  if (auto index = index_of_packets(path)) return *index;
  return index_of_frames(path);
}

}  // namespace relock
