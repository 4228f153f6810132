#include "simulation/height_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcrb_tools::simulation {
namespace {

using Eigen::Vector3d;

/// Walk of a ray over the cells of a grid, in the order in which it crosses them.
class GridWalk {
 public:
  /// @param x, y, dx, dy  the ray in units of cells.
  GridWalk(double x, double y, double dx, double dy)
      : ix(static_cast<int>(std::floor(x))),
        iy(static_cast<int>(std::floor(y))),
        step_x_(dx < 0.0 ? -1 : 1),
        step_y_(dy < 0.0 ? -1 : 1),
        delta_x_(std::abs(1.0 / dx)),
        delta_y_(std::abs(1.0 / dy)),
        next_x_(delta_x_ * (dx < 0.0 ? x - ix : ix + 1 - x)),
        next_y_(delta_y_ * (dy < 0.0 ? y - iy : iy + 1 - y)) {}

  /// Parameter at which the ray leaves the current cell.
  double leave() const { return std::min(next_x_, next_y_); }

  void advance() {
    if (next_x_ < next_y_) {
      ix += step_x_;
      next_x_ += delta_x_;
    } else {
      iy += step_y_;
      next_y_ += delta_y_;
    }
  }

  int ix;
  int iy;

 private:
  int step_x_, step_y_;
  double delta_x_, delta_y_;
  double next_x_, next_y_;
};

/// Part [enter, leave] of a ray inside a box.
struct Span {
  double enter = 0.0;
  double leave;

  void clip(double origin, double direction, double low, double high) {
    if (direction == 0.0) {
      if (origin < low || origin > high) leave = -1.0;
      return;
    }
    const double a = (low - origin) / direction;
    const double b = (high - origin) / direction;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
};

/// Bits of a place on the lattice, well mixed (the finalizer of splitmix64).
double latticeValue(std::int64_t ix, std::int64_t iy, std::uint64_t seed) {
  std::uint64_t bits = seed + 0x9e3779b97f4a7c15ULL * static_cast<std::uint64_t>(ix) +
                       0xd1b54a32d192ed03ULL * static_cast<std::uint64_t>(iy);
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9ULL;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebULL;
  bits ^= bits >> 31;
  return static_cast<double>(bits >> 11) * 0x1.0p-52 - 1.0;
}

double smoothStep(double t) { return t * t * t * (t * (6.0 * t - 15.0) + 10.0); }

double mix(double a, double b, double share) { return a + (b - a) * share; }

}  // namespace

HeightField::HeightField(double half_extent, double cell, Surface surface,
                         const std::function<double(double, double)>& height)
    : half_extent_(half_extent),
      cell_(cell),
      side_(static_cast<int>(std::lround(2.0 * half_extent / cell)) + 1),
      surface_(surface) {
  corners_.reserve(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_));
  for (int iy = 0; iy < side_; ++iy) {
    for (int ix = 0; ix < side_; ++ix) {
      corners_.push_back(
          static_cast<float>(height(ix * cell - half_extent, iy * cell - half_extent)));
    }
  }
  lowest_ = *std::min_element(corners_.begin(), corners_.end());
  highest_ = *std::max_element(corners_.begin(), corners_.end());
}

std::optional<Hit> HeightField::intersect(const Ray& ray, double limit) const {
  Span span{0.0, limit};
  const double margin = 1e-9;  // a flat field keeps a slab to be in
  span.clip(ray.origin.x(), ray.direction.x(), -half_extent_, half_extent_);
  span.clip(ray.origin.y(), ray.direction.y(), -half_extent_, half_extent_);
  span.clip(ray.origin.z(), ray.direction.z(), lowest_ - margin, highest_ + margin);
  if (span.enter >= span.leave) return std::nullopt;

  const Vector3d start = ray.origin + span.enter * ray.direction;
  GridWalk walk((start.x() + half_extent_) / cell_, (start.y() + half_extent_) / cell_,
                ray.direction.x() / cell_, ray.direction.y() / cell_);
  double enter = span.enter;
  while (enter < span.leave) {
    const double leave = std::min(span.enter + walk.leave(), span.leave);
    if (auto hit = intersectCell(ray, walk.ix, walk.iy, enter, leave)) return hit;
    walk.advance();
    enter = leave;
  }
  return std::nullopt;
}

std::optional<Hit> HeightField::intersectCell(const Ray& ray, int ix, int iy, double enter,
                                              double leave) const {
  if (ix < 0 || iy < 0 || ix + 1 >= side_ || iy + 1 >= side_) return std::nullopt;
  const double z00 = corner(ix, iy);
  const double z10 = corner(ix + 1, iy);
  const double z01 = corner(ix, iy + 1);
  const double z11 = corner(ix + 1, iy + 1);
  const double lowest_ray =
      ray.origin.z() + ray.direction.z() * (ray.direction.z() < 0.0 ? leave : enter);
  if (lowest_ray > std::max({z00, z10, z01, z11})) return std::nullopt;

  // Triangle below the diagonal from (0, 0) to (1, 1), then the one above it: z = z00 + a u + b v.
  const double u0 = (ray.origin.x() + half_extent_) / cell_ - ix;
  const double v0 = (ray.origin.y() + half_extent_) / cell_ - iy;
  const double du = ray.direction.x() / cell_;
  const double dv = ray.direction.y() / cell_;
  std::optional<Hit> nearest;
  for (const bool below : {true, false}) {
    const double a = below ? z10 - z00 : z11 - z01;
    const double b = below ? z11 - z10 : z01 - z00;
    const double rate = ray.direction.z() - a * du - b * dv;
    if (rate >= 0.0) continue;  // not from above
    const double t = (z00 + a * u0 + b * v0 - ray.origin.z()) / rate;
    const double slack = 1e-9;  // neighbours share their edges
    const double u = u0 + t * du;
    const double v = v0 + t * dv;
    if (t < enter - slack || t > leave + slack || t <= 0.0 ||
        (below ? v > u + slack : u > v + slack))
      continue;
    if (nearest && nearest->distance <= t) continue;
    nearest = Hit{t, Vector3d(-a, -b, cell_).normalized(), surface_};
  }
  return nearest;
}

double HeightField::height(double x, double y) const {
  const double last = side_ - 1;
  const double gx = std::clamp((x + half_extent_) / cell_, 0.0, last);
  const double gy = std::clamp((y + half_extent_) / cell_, 0.0, last);
  const int ix = std::min(static_cast<int>(gx), side_ - 2);
  const int iy = std::min(static_cast<int>(gy), side_ - 2);
  const double u = gx - ix;
  const double v = gy - iy;
  const double z00 = corner(ix, iy);
  const double z11 = corner(ix + 1, iy + 1);
  return v <= u ? z00 + (corner(ix + 1, iy) - z00) * u + (z11 - corner(ix + 1, iy)) * v
                : z00 + (z11 - corner(ix, iy + 1)) * u + (corner(ix, iy + 1) - z00) * v;
}

double valueNoise(double x, double y, std::uint64_t seed) {
  const double floor_x = std::floor(x);
  const double floor_y = std::floor(y);
  const auto ix = static_cast<std::int64_t>(floor_x);
  const auto iy = static_cast<std::int64_t>(floor_y);
  const double u = smoothStep(x - floor_x);
  const double v = smoothStep(y - floor_y);
  return mix(mix(latticeValue(ix, iy, seed), latticeValue(ix + 1, iy, seed), u),
             mix(latticeValue(ix, iy + 1, seed), latticeValue(ix + 1, iy + 1, seed), u), v);
}

double fractalNoise(double x, double y, std::uint64_t seed, double wavelength, int octaves,
                    double roughness) {
  double sum = 0.0;
  double amplitude = 1.0;
  double frequency = 1.0 / wavelength;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += amplitude *
           valueNoise(x * frequency, y * frequency, seed + static_cast<std::uint64_t>(octave));
    amplitude *= roughness;
    frequency *= 2.0;
  }
  return sum;
}

}  // namespace pcrb_tools::simulation
