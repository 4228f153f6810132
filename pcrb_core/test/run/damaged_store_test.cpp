#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "pcrb_core/random.hpp"
#include "pcrb_core/run/merge_runs.hpp"
#include "pcrb_core/run/results_store.hpp"
#include "run/some_results.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb {
namespace {

constexpr int kDamages = 400;

std::string bytesOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Some bytes are others, or the end is missing.
std::string damaged(std::string bytes, Random& random) {
  if (random.uniform(0, 1) < 0.2) return bytes.substr(0, random.below(bytes.size()));
  for (std::uint64_t i = 0; i <= random.below(20); ++i) {
    bytes[random.below(bytes.size())] = static_cast<char>(random.below(256));
  }
  return bytes;
}

/// Whoever has damaged a store, reading and merging it gives valid results or a StoreError.
TEST(DamagedStore, IsReadAsResultsThatCouldHaveBeenWrittenOrRefused) {
  const pcrb_test::TemporaryFolder folder;
  {
    ResultsStore store(folder.file("whole"), ResultsStore::Access::kReadWrite);
    store.setRunInfo({{"secret", "000102030405060708090a0b0c0d0e0f"}, {"shard", "0/1"}});
    for (int i = 0; i < 50; ++i) store.add(pcrb_test::fullResult(std::to_string(1000 + i)));
  }
  const std::string whole = bytesOf(folder.file("whole") + "/results.sqlite");
  const std::string run = folder.file("run");
  std::filesystem::create_directories(run);
  Random random(11);
  int read = 0;
  for (int i = 0; i < kDamages; ++i) {
    std::ofstream(run + "/results.sqlite", std::ios::binary) << damaged(whole, random);
    try {
      const ResultsStore store(run, ResultsStore::Access::kReadOnly);
      store.runInfo();
      for (const Result& result : store.results()) {
        EXPECT_TRUE(result.error >= 0.0 && std::isfinite(result.error));
        EXPECT_TRUE(result.overlap >= 0.0 && result.overlap <= 1.0);
      }
      ++read;
    } catch (const Error&) {
    }
    try {
      MergeOptions options;
      options.runs = {run};
      options.output = folder.file("merged");
      mergeRuns(options);
    } catch (const Error&) {
    }
    std::filesystem::remove_all(folder.file("merged"));
  }
  EXPECT_GT(read, 0);  // damages that change no value, or one that may be
  EXPECT_LT(read, kDamages);
}

}  // namespace
}  // namespace pcrb
