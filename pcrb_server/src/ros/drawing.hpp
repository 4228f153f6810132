#pragma once

#include <std_msgs/Header.h>
#include <visualization_msgs/Marker.h>

#include <Eigen/Core>
#include <string>

#include "pcrb_core/run/result.hpp"

namespace pcrb {

/// Text above a position (m, in the header's frame) that always faces the viewer; of a size for the
/// distance from which the rviz configurations look, whatever the extent of the clouds.
visualization_msgs::Marker textMarker(const std_msgs::Header& header,
                                      const Eigen::Vector3d& position, const std::string& text);

/// E.g. `error 0.0123 (initial 0.2)`; a second line says so where there was no valid reply.
std::string errorText(const Result& result);

}  // namespace pcrb
