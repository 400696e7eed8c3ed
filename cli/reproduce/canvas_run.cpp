#include "cli/reproduce/canvas_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>

#include "cli/files.h"
#include "cli/in_parallel.h"
#include "cli/judged_picture.h"
#include "cli/print/targets.h"
#include "cli/terminal.h"
#include "cli/version.h"
#include "core/opencv.h"

namespace relock::reproduction {
namespace {

namespace fs = std::filesystem;

/// One line that tells all that a contender's answers depend on.
std::string made_by(const CanvasExperiment& experiment, const Contender& contender,
                    const ChosenDetector& chosen) {
  const simulator::CanvasPlan& p = experiment.plan;
  std::string options;
  for (const auto& [name, value] : chosen.options.values())
    options += fmt::format("{}{}={}", options.empty() ? "" : ",", name, value);
  std::string text = fmt::format(
      "relock {}; {}({}) on {}; {} px of {:g} around {:g} px, noise {:g}, blur {:g} px at {:g} degrees in "
      "{}, {} "
      "times, "
      "seed {}",
      kVersion, chosen.entry->name, options, contender.target, p.canvas_px, p.grey, p.marker_px, p.noise,
      fmt::join(p.lengths_px, " "), fmt::join(p.angles_deg, " "),
      p.blur_in == simulator::BlurIn::coded ? "grey levels" : "light", p.repetitions, experiment.seed);
  if (chosen.entry->plugin) text += fmt::format("; plug-in {}", chosen.entry->plugin->fingerprint);
  return text;
}

fs::path file_of(const CanvasExperiment& experiment, const Contender& contender, const Settings& settings) {
  return settings.out / experiment.name / slug(contender.method) / (slug(contender.target) + ".csv");
}

std::vector<PictureAnswer> answers_of(const CanvasExperiment& experiment, const Contender& contender,
                                      const ChosenDetector& chosen, int jobs,
                                      const std::function<void()>& picture_done) {
  const PrintedTarget target = target_on_canvas(contender.target);
  std::vector<PictureAnswer> answers(simulator::canvas_pictures(experiment.plan));
  in_parallel(answers.size(), jobs, [&] {
    return [&, detector = std::shared_ptr<Detector>(chosen.make())](std::size_t rank) {
      const auto picture = simulator::canvas_picture(experiment.plan, target, rank, experiment.seed);
      answers[rank] = judged(target, picture, detector->detect(view(picture.pixels)));
      const std::size_t cell = rank / static_cast<std::size_t>(experiment.plan.repetitions);
      answers[rank].blur_px = experiment.plan.lengths_px[cell / experiment.plan.angles_deg.size()];
      answers[rank].angle_deg = experiment.plan.angles_deg[cell % experiment.plan.angles_deg.size()];
      picture_done();
    };
  });
  return answers;
}

}  // namespace

PrintedTarget target_on_canvas(const std::string& name) { return print_target(name, 0.15); }

PictureAnswer judged(const PrintedTarget& target, const simulator::CanvasPicture& picture,
                     const Sightings& sightings) {
  const FrameJudgement frame = judged_alone(
      one_frame(picture.pixels, {{target.name, target.code, target.size_m}}, {picture.truth}), sightings);
  const Judgement& judgement = frame.targets.front();

  PictureAnswer answer;
  answer.verdict = judgement.verdict;
  answer.uncoded = judgement.uncoded;
  answer.spurious = frame.spurious;
  if (judgement.sighting < 0) return answer;
  const Sighting& sighting = sightings[static_cast<std::size_t>(judgement.sighting)];
  const Vec2 error = sighting.centre - picture.truth.centre(sighting.centre_kind);
  answer.error_px = std::hypot(error.x, error.y);
  const Vec2 blur = picture.truth.blur.value_or(Vec2{});
  if (const double length = std::hypot(blur.x, blur.y); length > 0) {
    answer.along_px = (error.x * blur.x + error.y * blur.y) / length;
    answer.across_px = (error.y * blur.x - error.x * blur.y) / length;
  }
  return answer;
}

std::vector<CanvasResult> run_canvas(const CanvasExperiment& experiment,
                                     const std::vector<Contender>& contenders, const Settings& settings,
                                     const Methods& methods) {
  simulator::check_canvas(experiment.plan);
  const std::size_t pictures = simulator::canvas_pictures(experiment.plan);
  std::vector<CanvasResult> results;
  std::vector<std::size_t> missing;
  std::vector<ChosenDetector> chosen;
  for (const Contender& contender : contenders) {
    chosen.push_back(choose_detector(methods, contender.method));
    const auto there = read_answers(file_of(experiment, contender, settings),
                                    made_by(experiment, contender, chosen.back()), pictures);
    if (!there) missing.push_back(results.size());
    results.push_back({contender, there.value_or(std::vector<PictureAnswer>{})});
  }

  Progress progress(experiment.name, static_cast<std::int64_t>(missing.size() * pictures));
  std::int64_t done = 0;
  for (const std::size_t i : missing) {
    const Contender& contender = contenders[i];
    const fs::path file = file_of(experiment, contender, settings);
    const std::string line = made_by(experiment, contender, chosen[i]);
    std::mutex counting;
    const auto answers = answers_of(experiment, contender, chosen[i], settings.jobs, [&] {
      const std::lock_guard lock(counting);
      progress.done(++done);
    });
    make_folder(file.parent_path());
    write_file(file, answers_text(line, answers));
    results[i].answers = *read_answers(file, line, pictures);  // rounded as they will be next time
  }
  return results;
}

}  // namespace relock::reproduction
