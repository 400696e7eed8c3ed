#include "cli/loss_sentences.h"

#include <fmt/format.h>

#include <cctype>

#include "eval/loss_text.h"

namespace relock {

std::string as_sentence(std::string text) {
  if (text.empty()) return text;
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text + ".";
}

LossSentences sentences_of(const Recording& recording, const Trajectory& trajectory, std::size_t target,
                           const Loss& loss) {
  const Circumstances came_with = circumstances(recording, trajectory, target, loss);
  const std::string arrival = arrival_text(came_with), said = said_text(loss);
  return {as_sentence(fmt::format("{}; {}", onset_text(recording, loss, came_with, gap_note(came_with)),
                                  end_text(recording, loss))),
          arrival.empty() ? "" : as_sentence("the target was " + arrival),
          said.empty() ? "" : as_sentence("while lost, it said " + said)};
}

}  // namespace relock
