#include "common/tool_main.hpp"
#include "conversion/conversion_main.hpp"
#include "conversion/eth_conversion.hpp"

int main(int argc, char** argv) {
  pcrb_tools::EthRequest request;
  CLI::App app{"Converts a sequence of the ETH / ASL data set."};
  pcrb_tools::addConversionOptions(
      app, request, "Folders or archives (zip, tgz) with csv_global or with csv_local and leica");
  pcrb_tools::addChoice<pcrb::EthFrame>(
      app, "--frame", request.frame,
      {{"global", pcrb::EthFrame::kGlobal}, {"local", pcrb::EthFrame::kLocal}},
      "Scans to read: global (PointCloudN.csv) or local (Hokuyo_N.csv, moved by the "
      "Leica poses); default: global if there are any");
  app.footer("Example: eth_to_pcd ~/logs/eth/apartment --root ~/benchmark");
  return pcrb_tools::runConversion(app, argc, argv, request,
                                   [&request] { return pcrb_tools::convertEth(request); });
}
