namespace pcrb_tools::PCRB_TOOL {
int run(int argc, char** argv);
}

/// Compiled once for each program: `report` with PCRB_TOOL=report, which is in tools/report.cpp.
int main(int argc, char** argv) { return pcrb_tools::PCRB_TOOL::run(argc, argv); }
