#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pcrb_core/random.hpp"
#include "simulation/scene.hpp"

namespace pcrb_tools::simulation {

/// Structured-light RGB-D camera (Kinect), depth registered to the colour image. Optical frame:
/// x right, y down, z ahead.
struct DepthCamera {
  int width;     ///< pixels
  int height;    ///< pixels
  double focal;  ///< pixels, both axes
  double center_x, center_y;
};

/// The data set's recommended intrinsics, 640 × 480; `divisor` 2 or 4 gives smaller images.
DepthCamera makeKinect(int divisor);

/// One image pair, row by row.
struct RgbdFrame {
  std::vector<float> depth;         ///< m along z; NaN where the camera sees none
  std::vector<std::uint8_t> color;  ///< red, green, blue of each pixel
};

/// Takes a picture with the noise of the sensor: depth from a disparity with noise, in steps of an
/// eighth of a pixel, so that its error grows with the square of the distance; then in whole mm, as
/// the driver delivers it. There is no depth in the projector's shadow, on surfaces that are dark
/// or seen at a grazing angle, and outside 0.5 to 5 m.
///
/// Source of the model: Khoshelham and Elberink, Accuracy and resolution of Kinect depth data,
/// Sensors 12 (2012), eq. 11.
RgbdFrame takeFrame(const Scene& scene, const DepthCamera& camera,
                    const pcrb::Transform& T_world_camera, double time, pcrb::Random& random);

}  // namespace pcrb_tools::simulation
