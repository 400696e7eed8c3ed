#pragma once

#include <memory>
#include <optional>
#include <string>

#include "cli/conformance/scene.h"
#include "cli/conformance/stage.h"
#include "cli/method_spec.h"
#include "cli/program.h"

namespace relock {

/// The method that is checked: a tracker or a detector. Exactly one entry is there; it must outlive this.
struct Subject {
  const TrackerEntry* tracker = nullptr;
  const DetectorEntry* detector = nullptr;
  std::shared_ptr<const TrackerEntry> combined = {};  ///< holds the tracker's entry if it is a combination
  Options options;
  std::string text;                   ///< as it would be typed
  std::optional<std::string> family;  ///< of a code that it reads and whose print relock can draw

  const std::string& name() const { return tracker ? tracker->name : detector->name; }
  const std::vector<OptionInfo>& option_list() const {
    return tracker ? tracker->options : detector->options;
  }
  const std::string& sentence() const { return tracker ? tracker->sentence : detector->sentence; }
  /// A detector's entry cannot say otherwise.
  bool deterministic() const { return !tracker || tracker->deterministic; }
};

/// The print of some code of this family; nothing when relock does not know such codes.
std::optional<MarkerCells> print_of(const std::string& family);

/// Throws Error for an unknown name or option, and for mute and oracle, which are no methods. Values are
/// checked later: the method's own code runs in child processes only.
Subject subject_called(const Methods& methods, const MethodSpec& spec);

/// A tracker or a detector at work, driven in the same way.
class Session {
 public:
  virtual ~Session() = default;
  virtual void start(const Frame& frame, const Box& box) = 0;  ///< nothing for a detector
  virtual Sightings see(const Frame& frame) = 0;
};
std::unique_ptr<Session> session(const Subject& subject, std::uint64_t seed);

/// A scene that suits the subject: with a marker for detectors that read a code whose print relock can draw,
/// else with a textured target.
struct Stand {
  Scene scene;
  Box start;  ///< of the target, at the left
};
Stand usual_stand(const Subject& subject);
Stand small_stand(const Subject& subject);

/// What is wrong with an answer on a picture of this size; nothing when it is well formed.
std::optional<std::string> complaint(const Sightings& sightings, Size picture);
/// The answer, digit by digit.
std::string text_of(const Sightings& sightings);
/// "frame 3 (the target leaves the picture)".
std::string place_of(const Shot& shot);

/// Shows a film to a new session of the subject; every answer must be well formed. Gives the answers. What
/// may be refused with an Error is left out of them.
enum class Refusal : std::uint8_t { fails, is_allowed };
std::vector<Sightings> show(const Subject& subject, Session& session, const Film& film, Stage& stage,
                            Refusal refusal = Refusal::fails);

}  // namespace relock
