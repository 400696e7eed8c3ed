// The relock program with one more method built in.

#include "cli/program.h"

class Everything final : public relock::Detector {
 public:
  relock::Sightings detect(const relock::Image& image, const std::optional<relock::Box>&) override {
    return {relock::sighting_of(relock::picture_box(image.size()))};
  }
};

int main(int argc, char** argv) {
  auto methods = relock::builtin_methods();
  methods.detectors.add(
      {.name = "everything",
       .sentence = "the whole picture",
       .make = [](const relock::Options&, std::uint64_t) { return std::make_unique<Everything>(); }});
  return relock::run_program(argc, argv, methods);
}
