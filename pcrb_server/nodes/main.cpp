namespace pcrb::PCRB_NODE {
int run(int argc, char** argv);
}

/// Compiled once for each node: `replay` with PCRB_NODE=replay, which is in nodes/replay.cpp.
int main(int argc, char** argv) { return pcrb::PCRB_NODE::run(argc, argv); }
