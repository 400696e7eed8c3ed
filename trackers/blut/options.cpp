#include "trackers/blut/options.h"

#include <fmt/format.h>

namespace relock {
namespace {

using List = std::vector<OptionInfo>;

std::string text(double value) { return fmt::format("{}", value); }
std::string text(int value) { return fmt::format("{}", value); }
std::string text(bool value) { return value ? "true" : "false"; }

void append(List& list, const List& more) { list.insert(list.end(), more.begin(), more.end()); }

/// What `l1` has, too.
List sparse_option_list() {
  const BlutOptions d;
  List list = particles::particle_option_list();
  append(list,
         {{"templates", text(d.templates), "",
           "sharp templates that are updated, beside one that is not; L1-APG's"},
          {"template_weight", text(d.template_weight), "",
           "weight of the sharp templates in the sum; as the first l1 tracker is recalled"},
          {"trivial_weight", text(d.solver.trivial_weight), "",
           "weight of the trivial templates: a sample's error counts no more than in proportion beyond it"},
          {"trivial_ridge", text(d.solver.trivial_ridge), "",
           "weight of the trivial templates' squares; 10 with a trivial_weight of 0.001 is L1-APG's mode"},
          {"solver", "accurate", "", "accurate or fast; accurate, because the blur is wrong without"},
          {"bound", text(d.bound), "",
           "leave out particles that cannot matter, by the minimal error bound of L1-APG"},
          {"velocity", text(d.proposal.velocity), "",
           "a lobe at the last velocity; off: nothing tells that the published trackers had one"},
          {"velocity_share", text(d.proposal.velocity_share), "",
           "part of the particles that go into the velocity's lobe, of those in no blur lobe; assumed"},
          {"velocity_spread", text(d.proposal.velocity_spread), "",
           "spread of that lobe, of the velocity; assumed"},
          {"update", text(d.update), "", "learn new sharp templates"},
          {"update_angle_deg", text(d.update_angle_deg), "deg",
           "angle between a look and its best template above which it is learnt; L1-APG's 40 hardly ever "
           "learns"},
          {"occlusion_level", text(d.occlusion_level), "",
           "what no template explains of a sample, of a look's standard deviation, to count as occluded; "
           "L1-APG's 0.03 on a grid of 12 x 15"},
          {"occlusion_share", text(d.occlusion_share), "",
           "part of the grid occluded in one piece, above which nothing is learnt; L1-APG's"},
          {"occlusion_frames", text(d.occlusion_frames), "frames",
           "how long nothing is learnt after an occlusion; L1-APG's"}});
  return list;
}

particles::ProposalOptions proposal_of(const Options& given) {
  particles::ProposalOptions o;
  o.velocity = given.flag("velocity");
  o.velocity_share = given.number("velocity_share", 0, 1);
  o.velocity_spread = given.number("velocity_spread", 0, 10);
  return o;
}

blut::SolverOptions solver_of(const Options& given) {
  blut::SolverOptions o;
  o.trivial_weight = given.number("trivial_weight", 0, 10);
  o.trivial_ridge = given.number("trivial_ridge", 0, 1000);
  if (given.word("solver", {"accurate", "fast"}) == "fast") {
    o.rounds = 4;
    o.sweeps = 3;
  }
  return o;
}

BlutOptions sparse_options(const Options& given) {
  BlutOptions o;
  o.particles = particles::particle_options(given);
  o.proposal = proposal_of(given);
  o.solver = solver_of(given);
  o.templates = given.whole("templates", 1, 1000);
  o.template_weight = given.number("template_weight", 0, 10);
  o.update_angle_deg = given.number("update_angle_deg", 0, 180);
  o.occlusion_level = given.number("occlusion_level", 0, 100);
  o.occlusion_share = given.number("occlusion_share", 0, 1);
  o.occlusion_frames = given.whole("occlusion_frames", 0, 100'000);
  o.update = given.flag("update");
  o.bound = given.flag("bound");
  return o;
}

}  // namespace

List l1_option_list() { return sparse_option_list(); }

BlutOptions l1_options(const Options& given) {
  BlutOptions o = sparse_options(given);
  o.blur_templates = false;
  o.proposal.blur_lobes = false;
  return o;
}

List blut_option_list() {
  const BlutOptions d;
  List list = sparse_option_list();
  append(
      list,
      {{"blur_templates", text(d.blur_templates), "",
        "templates of the blurred target; without, no blur is told"},
       {"directions", text(d.fan.directions), "", "directions of the blur templates; recalled"},
       {"lengths", text(d.fan.lengths), "", "lengths of the blur templates; recalled"},
       {"shortest_blur", text(d.fan.shortest), "", "shortest of them, of the target's width; assumed"},
       {"longest_blur", text(d.fan.longest), "", "longest of them, of the target's width; assumed"},
       {"blur_weight", text(d.blur_weight), "", "weight of the blur templates in the sum; assumed"},
       {"direction_weight", text(d.direction_weight), "",
        "how much dearer a blur template is that is across the last blur; off: only its form is recalled"},
       {"blurred_share", text(d.reading.blurred_share), "",
        "part of the coefficients that blur templates have, above which the target is blurred; assumed"},
       {"least_blur", text(d.reading.least_blur), "",
        "shortest blur that is told, of the target's width; assumed: an error of place of a sample looks "
        "like a shorter one"},
       {"blur_length", "spread", "",
        "spread or mean: length that spreads as the sum of all templates does, or mean of the blurred ones, "
        "as recalled, which is too long for short blurs"},
       {"blur_lobes", text(d.proposal.blur_lobes), "",
        "after a blurred frame, particles go where the blur says that the target went, on both sides"},
       {"kappa", text(d.proposal.kappa), "",
        "frame period over exposure: how many blur lengths the target moves in a frame; 33 ms over 28 ms"},
       {"lobe_share", text(d.proposal.lobe_share), "", "part of the particles in the two lobes; assumed"},
       {"lobe_spread", text(d.proposal.lobe_spread), "",
        "spread of a lobe along the motion, of its distance; assumed"}});
  return list;
}

BlutOptions blut_options(const Options& given) {
  BlutOptions o = sparse_options(given);
  o.blur_templates = given.flag("blur_templates");
  o.fan = {.directions = given.whole("directions", 1, 180),
           .lengths = given.whole("lengths", 1, 100),
           .shortest = given.number("shortest_blur", 0.001, 5),
           .longest = given.number("longest_blur", 0.001, 5)};
  if (o.fan.shortest > o.fan.longest)
    throw Error(fmt::format("blut: option shortest_blur is {:g}; it must be no more than longest_blur, {:g}",
                            o.fan.shortest, o.fan.longest));
  o.blur_weight = given.number("blur_weight", 0, 10);
  o.direction_weight = given.number("direction_weight", 0, 1000);
  o.reading.blurred_share = given.number("blurred_share", 0, 1);
  o.reading.least_blur = given.number("least_blur", 0, 5);
  o.reading.length = given.word("blur_length", {"spread", "mean"}) == "mean"
                         ? blut::BlurReading::Length::mean
                         : blut::BlurReading::Length::spread;
  o.proposal.blur_lobes = given.flag("blur_lobes");
  o.proposal.kappa = given.number("kappa", 0, 1000);
  o.proposal.lobe_share = given.number("lobe_share", 0, 1);
  o.proposal.lobe_spread = given.number("lobe_spread", 0, 10);
  return o;
}

}  // namespace relock
