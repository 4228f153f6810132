#pragma once

#include <sensor_msgs/PointCloud2.h>

#include <vector>

namespace pcrb {

/// The times of a message's points in seconds, as the driver gives them, from the first field that
/// pointTimeScale() knows: FLOAT32, FLOAT64 or UINT32.
///
/// @return  empty where there is no such field.
/// @throws InvalidProblem  if the message's sizes do not fit its data, or the field has another
///                         type.
std::vector<double> pointTimes(const sensor_msgs::PointCloud2& message);

}  // namespace pcrb
