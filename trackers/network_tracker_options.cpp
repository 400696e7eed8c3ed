#include <fmt/format.h>

#include "trackers/network_tracker.h"

namespace relock {
namespace {

constexpr const char* kThresholdSentence = "score below which the target is called lost; 0: never";

OptionInfo file(const char* name, const char* sentence) { return {name, "", "file", sentence}; }

template <class Given>
OptionInfo score_threshold() {
  return {"score_threshold", fmt::format("{}", Given{}.score_threshold), "", kThresholdSentence};
}

}  // namespace

std::vector<OptionInfo> goturn_option_list() {
  return {file("model", "the network's structure, usually goturn.prototxt"),
          file("weights", "the network's weights, usually goturn.caffemodel")};
}

GoturnOptions goturn_options(const Options& given) {
  return {.model = given.word("model"), .weights = given.word("weights")};
}

std::vector<OptionInfo> dasiamrpn_option_list() {
  return {file("model", "the network, usually dasiamrpn_model.onnx"),
          file("kernel_cls1", "what makes its classifier, usually dasiamrpn_kernel_cls1.onnx"),
          file("kernel_r1", "what makes its regression, usually dasiamrpn_kernel_r1.onnx"),
          score_threshold<DasiamrpnOptions>()};
}

DasiamrpnOptions dasiamrpn_options(const Options& given) {
  return {.model = given.word("model"),
          .kernel_cls1 = given.word("kernel_cls1"),
          .kernel_r1 = given.word("kernel_r1"),
          .score_threshold = given.number("score_threshold", 0, 1)};
}

std::vector<OptionInfo> nano_option_list() {
  return {file("backbone", "the network that looks, usually nanotrack_backbone_sim.onnx"),
          file("head", "the network that compares, usually nanotrack_head_sim.onnx"),
          score_threshold<NanoOptions>()};
}

NanoOptions nano_options(const Options& given) {
  return {.backbone = given.word("backbone"),
          .head = given.word("head"),
          .score_threshold = given.number("score_threshold", 0, 1)};
}

std::vector<OptionInfo> vit_option_list() {
  return {file("model", "the network, usually object_tracking_vittrack with a date, .onnx"),
          score_threshold<VitOptions>()};
}

VitOptions vit_options(const Options& given) {
  return {.model = given.word("model"), .score_threshold = given.number("score_threshold", 0, 1)};
}

}  // namespace relock
