#include "conversion/conversion_main.hpp"
#include "conversion/live_node.hpp"
#include "conversion/tum_conversion.hpp"
#include "conversion/tum_options.hpp"

int main(int argc, char** argv) {
  if (pcrb_tools::takeLiveFlag(argc, argv)) return pcrb_tools::runTumNode(argc, argv);
  pcrb_tools::TumRequest request;
  CLI::App app{"Converts a sequence of the TUM RGB-D data set."};
  pcrb_tools::addConversionOptions(
      app, request,
      "Bags with clouds, raw bags with depth images and camera_info, or the data set's tgz or "
      "folder with depth.txt and PNGs");
  pcrb_tools::addTumOptions(app, request);
  app.footer(
      "Example: tum_to_pcd rgbd_dataset_freiburg2_pioneer_slam-2hz-with-pointclouds.bag "
      "--root ~/benchmark\n"
      "As a node, on what rosbag play or a camera publishes: --live (--live --help)");
  return pcrb_tools::runConversion(app, argc, argv, request,
                                   [&request] { return pcrb_tools::convertTum(request); });
}
