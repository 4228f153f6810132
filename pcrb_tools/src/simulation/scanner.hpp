#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "pcrb_core/random.hpp"
#include "simulation/scene.hpp"

namespace pcrb_tools::simulation {

/// How a time-of-flight lidar measures along one beam.
struct LidarModel {
  double min_range;     ///< m
  double max_range;     ///< m
  double range_noise;   ///< m, standard deviation
  double resolution;    ///< m, ranges are multiples of it
  double beam_radius;   ///< rad, half the beam's divergence
  double mixed_share;   ///< share of beams that see the rim of their footprint too: mixed pixels
  double lost_share;    ///< share of echoes lost for no visible reason
  double weakest_echo;  ///< of reflectivity · cos(incidence) · (max_range / range)²: less is lost
};

/// What comes back from one beam.
struct Echo {
  double range;     ///< m, as the sensor reports it
  double strength;  ///< reflectivity · cos(incidence), [0, 1]
};

/// Measures along a ray that starts at the sensor; nothing where no echo comes back.
std::optional<Echo> measure(const Scene::Snapshot& scene, const Ray& ray, const LidarModel& lidar,
                            pcrb::Random& random);

/// What a scanner reports of one beam.
struct ScanPoint {
  Eigen::Vector3d position;  ///< m, sensor frame of the moment; zero where no echo came back
  double strength;           ///< of the echo, [0, 1]; 0 where there is none
  double time;               ///< s since the start of the log
  int line;                  ///< number of the profile or column within the scan
  int index;                 ///< number of the beam within its line
};

/// A scanner that takes a 3D scan line by line: a 2D lidar on a tilting or panning head, or a
/// column of lasers on a spinning one.
struct Scanner {
  enum class Head {
    kTilting,  ///< the lines lie in the x-y plane and are nodded about y
    kPanning   ///< the lines stand in the x-z plane and are turned about z
  };

  Head head;
  LidarModel lidar;
  int lines;          ///< of a scan
  int beams;          ///< of a line
  double first_head;  ///< rad, head angle of the first line
  double last_head;   ///< rad, and of the last
  double first_beam;  ///< rad, azimuth (tilting) or elevation (panning) of the first beam
  double last_beam;   ///< rad, and of the last
  double duration;    ///< s, of a whole scan
};

/// Time of the middle of a line, s after the start of its scan.
double lineTime(const Scanner& scanner, int line);

/// Takes a scan, one point per beam in the order of time, from a sensor that may move meanwhile.
std::vector<ScanPoint> takeScan(const Scene& scene, const Scanner& scanner,
                                const Motion& T_world_sensor, double start_time,
                                pcrb::Random& random);

// The sensors of the four data sets; counts are theirs, fewer where a size asks for it.

/// Hokuyo UTM-30LX: 270° in the profile, nodded over 160°.
Scanner makeTiltingHokuyo(int lines, int beams);
/// SICK LMS on a panning mast (box_met).
Scanner makePanningSick(int lines, int beams);
/// SICK LMS on a nodding head, looking ahead (p2at_met).
Scanner makeTiltingSick(int lines, int beams);
/// Velodyne VLP-16, 10 Hz.
Scanner makeVlp16(int columns);

}  // namespace pcrb_tools::simulation
