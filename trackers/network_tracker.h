#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/options.h"
#include "core/tracker.h"

namespace relock {

// OpenCV's trackers that are neural networks, with the promises of trackers/checked_tracker.h. relock brings
// no networks: their files are named by options. All of them work on whole pixels, and scale the box.
//
// The files are loaded when a tracker is made, that is, once for each start: OpenCV's trackers below 4.11
// load them themselves and share nothing. Making one throws Error when a file is missing, is no network, or
// when the OpenCV that relock was built with has no such tracker.

/// Regression network (Held et al. 2016). Never calls the target lost.
struct GoturnOptions {
  std::string model;    ///< file of the network's structure, .prototxt
  std::string weights;  ///< file of its weights, .caffemodel
};

/// Distractor-aware siamese region proposal network (Zhu et al. 2018).
struct DasiamrpnOptions {
  std::string model;             ///< file of the network, .onnx
  std::string kernel_cls1;       ///< file of the network that makes the classifier of the start patch, .onnx
  std::string kernel_r1;         ///< and of the one that makes its regression, .onnx
  double score_threshold = 0.2;  ///< score below which the target is called lost; 0: never
};

/// NanoTrack, a small siamese network. Needs OpenCV 4.7.
struct NanoOptions {
  std::string backbone;          ///< file of the network that looks at pictures, .onnx
  std::string head;              ///< file of the network that compares them, .onnx
  double score_threshold = 0.2;  ///< score below which the target is called lost; 0: never
};

/// VitTrack, a small vision transformer. Needs OpenCV 4.9.
struct VitOptions {
  std::string model;             ///< file of the network, .onnx
  double score_threshold = 0.2;  ///< score below which the target is called lost; 0: never
};

std::vector<OptionInfo> goturn_option_list();
std::vector<OptionInfo> dasiamrpn_option_list();
std::vector<OptionInfo> nano_option_list();
std::vector<OptionInfo> vit_option_list();
// Each throws Error naming the option, the value and the legal range; files are looked at when a tracker is
// made.
GoturnOptions goturn_options(const Options& given);
DasiamrpnOptions dasiamrpn_options(const Options& given);
NanoOptions nano_options(const Options& given);
VitOptions vit_options(const Options& given);

// What each of them cannot work without, for TrackerEntry::needs: its files, or another OpenCV.
std::string goturn_needs();
std::string dasiamrpn_needs();
std::string nano_needs();
std::string vit_needs();

std::unique_ptr<Tracker> goturn_tracker(const GoturnOptions& options);
/// Confidence of this one and the two below is the network's own score.
std::unique_ptr<Tracker> dasiamrpn_tracker(const DasiamrpnOptions& options);
std::unique_ptr<Tracker> nano_tracker(const NanoOptions& options);
std::unique_ptr<Tracker> vit_tracker(const VitOptions& options);

}  // namespace relock
