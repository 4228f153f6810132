#include "conversion/converters.hpp"

/// Compiled once for each converter: `eth_to_pcd` with PCRB_CONVERTER=runEthConverter, and so on.
int main(int argc, char** argv) { return pcrb_tools::PCRB_CONVERTER(argc, argv); }
