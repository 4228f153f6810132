#include <utility>

#include "archives/bag_messages.hpp"
#include "conversion/kaist_gate.hpp"
#include "conversion/kaist_stream.hpp"
#include "conversion/message_scans.hpp"
#include "pcrb_core/error.hpp"

namespace pcrb_tools {

ConversionReport convertKaistBags(const KaistRequest& request) {
  const BagMessages bags(request.inputs);
  const std::size_t lefts = bags.count({request.left_topic});
  if (lefts == 0 || bags.count({request.right_topic}) == 0) {
    throw pcrb::InvalidFile(
        request.inputs.front(), 0,
        "no message on " + (lefts == 0 ? request.left_topic : request.right_topic),
        "scans of both sensors");
  }
  const KaistFrames frames = readFrames(request, nullptr);
  const std::string sequence = kaistSequence(request, request.inputs.front());
  Conversion conversion(request, sequence, lefts);
  KaistStream stream(frames, request, sequence, bags.identity(), conversion);
  bags.forEach({request.left_topic, request.right_topic},
               [&](const rosbag::MessageInstance& instance) {
                 const auto cloud = messageAs<sensor_msgs::PointCloud2>(instance);
                 if (instance.getTopic() == request.left_topic) {
                   stream.addLeft(cloud);
                 } else {
                   stream.addRight(cloud);
                 }
               });
  stream.finish();
  return conversion.finish();
}

}  // namespace pcrb_tools
