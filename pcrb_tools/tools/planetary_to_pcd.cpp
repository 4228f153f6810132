#include "conversion/conversion_main.hpp"
#include "conversion/planetary_conversion.hpp"

int main(int argc, char** argv) {
  pcrb_tools::PlanetaryRequest request;
  CLI::App app{
      "Converts box_met or p2at_met of the Canadian planetary emulation terrain data set."};
  pcrb_tools::addConversionOptions(app, request,
                                   "Folders or archives (zip, tgz) with <set>_NNN.xyz and .gt");
  app.footer("Example: planetary_to_pcd ~/logs/planetary/p2at_met --root ~/benchmark");
  return pcrb_tools::runConversion(app, argc, argv, request,
                                   [&request] { return pcrb_tools::convertPlanetary(request); });
}
