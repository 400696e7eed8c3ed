#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "sequences/simulator/exposure.h"
#include "sequences/simulator/scene.h"

namespace relock::simulator {

/// Four channels worked on at once; both compilers know this form of a vector.
using Pixel4 = float __attribute__((vector_size(16)));

/// Renders frames of a scene, each the mean in linear light of sub-exposures. One renderer may be used by several threads.
class Renderer {
 public:
  /// Keeps a reference to `scene`.
  Renderer(const Scene& scene, const Camera& camera);

  /// Farthest that anything seen moves in the picture during the exposure, along its way, px.
  double motion_px(const Exposure& exposure) const;
  /// How many sub-exposures the plan wants for that: 1 when nothing moves.
  static int steps_for(double motion_px, const ExposurePlan& plan);

  /// The light on the sensor, CV_32FC3 of the camera's size (reused where it fits): reflected light, 1 is white in full light,
  /// the exposure's own light not yet counted in.
  void render(const Exposure& exposure, int steps, cv::Mat& light) const;

 private:
  struct Row;
  struct Seen;
  struct Footprint;
  struct Places;

  Seen see(const Surface& surface, std::size_t index, const Pose& pose, double t) const;
  std::vector<Seen> seen_at(const Exposure& exposure, double t) const;
  void add_step(const Exposure& exposure, double t, cv::Mat& sum) const;
  void set_bounds(Seen& seen, const Eigen::Vector3d& corner, const Eigen::Vector3d& right,
                  const Eigen::Vector3d& down) const;
  Footprint footprint_of(const Seen& seen, float x, float y) const;
  static Pixel4 texel_at(const Footprint& footprint, float u, float v);
  static Pixel4 seen_at_place(const Seen& seen, const Footprint& footprint, float u, float v);
  static float mirrored(const Seen& seen, const Eigen::Vector3f& point);
  Pixel4 seen_finely(const Seen& seen, const Footprint& footprint, float x, float y) const;
  void draw_row(const Seen& seen, Row& row) const;
  std::optional<Eigen::Vector3d> first_hit(const Pose& pose, double t, Vec2 pixel) const;

  const Scene& scene_;
  Camera camera_;
  std::vector<bool> fine_;              // surfaces that are sampled finely: targets' sheets
  int padded_ = 0;                      // length of a row in rays_x_ and rays_y_
  std::vector<float> rays_x_, rays_y_;  // normalised place of each pixel
};

}  // namespace relock::simulator
