#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "simulation/shape.hpp"

namespace pcrb_tools::simulation {

/// Ground given as heights over a square grid, two triangles a cell.
class HeightField {
 public:
  /// Samples `height(x, y)` in m at the corners of square cells.
  ///
  /// @param half_extent  m; the field covers [−half_extent, half_extent] in x and y.
  /// @param cell         m, the cells' side.
  HeightField(double half_extent, double cell, Surface surface,
              const std::function<double(double, double)>& height);

  /// First intersection nearer than `limit` m; the field is seen from above only.
  std::optional<Hit> intersect(const Ray& ray, double limit) const;

  /// Height of the ground, m. Outside the field: that of its nearest border point.
  double height(double x, double y) const;

 private:
  float corner(int ix, int iy) const {
    return corners_[static_cast<std::size_t>(iy) * static_cast<std::size_t>(side_) +
                    static_cast<std::size_t>(ix)];
  }
  std::optional<Hit> intersectCell(const Ray& ray, int ix, int iy, double enter,
                                   double leave) const;

  double half_extent_;
  double cell_;
  int side_;                    ///< corners along an axis
  std::vector<float> corners_;  ///< m, row by row
  float lowest_;
  float highest_;
  Surface surface_;
};

/// Smooth random landscape in [−1, 1]: value noise of one octave on a lattice of 1 m, a pure
/// function of the place and the seed.
double valueNoise(double x, double y, std::uint64_t seed);

/// Octaves of value noise, each of half the wavelength and `roughness` times the height of the
/// one before; `wavelength` in m is the first one's, the result is in [−1, 1] times about 1.
double fractalNoise(double x, double y, std::uint64_t seed, double wavelength, int octaves,
                    double roughness);

}  // namespace pcrb_tools::simulation
