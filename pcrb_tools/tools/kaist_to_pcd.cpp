#include "conversion/conversion_main.hpp"
#include "conversion/kaist_conversion.hpp"
#include "conversion/kaist_options.hpp"
#include "conversion/live_node.hpp"

int main(int argc, char** argv) {
  if (pcrb_tools::takeLiveFlag(argc, argv)) return pcrb_tools::runKaistNode(argc, argv);
  pcrb_tools::KaistRequest request;
  CLI::App app{"Converts a sequence of the KAIST urban data set."};
  pcrb_tools::addConversionOptions(app, request,
                                   "Folders or archives (tgz, zip) with sensor_data, calibration "
                                   "and global_pose.csv, or bags of "
                                   "the two velodyne topics");
  pcrb_tools::addKaistOptions(app, request);
  app.footer(
      "Example: kaist_to_pcd ~/logs/kaist/urban05 --root ~/benchmark\n"
      "As a node, on what the data set's player or rosbag play publishes: --live "
      "(--live --help)");
  return pcrb_tools::runConversion(app, argc, argv, request,
                                   [&request] { return pcrb_tools::convertKaist(request); });
}
