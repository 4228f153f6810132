#include "fetch/dspace.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "fetch/fetch_tool.hpp"
#include "pcrb_core/error.hpp"
#include "support/expect_error.hpp"
#include "support/file_servers.hpp"
#include "support/log_folder.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

/// A repository with five files, two a page.
class DspaceTest : public ::testing::Test {
 protected:
  DspaceTest() : servers_(folder_.path()) {
    for (const char* name :
         {"a.zip", "b.zip", "c.zip", "d.zip", "plain_01-Sep-2011-16_39_18.zip"}) {
      pcrb_test::writeArchive(folder_.file(name), {{"csv_global/PointCloud0.csv", name}});
    }
    policy_.first_delay = std::chrono::milliseconds(0);
    policy_.attempts = 2;
    place_.url = servers_.http("/dspace");
    place_.dspace_item = "item";
    place_.dspace_name = "plain_01-Sep-2011-16_39_18.zip";
  }

  Place find() const { return findInDspace(place_, folder_.file("answer.json"), policy_); }

  pcrb_test::TemporaryFolder folder_;
  pcrb_test::FileServers servers_;
  DownloadPolicy policy_;
  Place place_;
};

TEST_F(DspaceTest, FindsAddressSizeAndChecksumOfAFileOnTheLastPage) {
  const Place found = find();
  EXPECT_EQ(found.url, servers_.http("/dspace/core/bitstreams/" + place_.dspace_name + "/content"));
  EXPECT_EQ(found.bytes, std::filesystem::file_size(folder_.file(place_.dspace_name)));
  requireMd5(folder_.file(place_.dspace_name), found.md5);
  EXPECT_TRUE(found.sha256.empty());
  EXPECT_FALSE(std::filesystem::exists(folder_.file("answer.json")));
}

TEST_F(DspaceTest, NamesTheFilesThatThereAreInPlaceOfTheWantedOne) {
  place_.dspace_name = "stairs.zip";
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, find(),
                    "found the files a.zip, b.zip, c.zip, d.zip, plain_01-Sep-2011-16_39_18.zip, "
                    "expected stairs.zip");
  place_.dspace_item = "gone";
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, find(), "the server answers with status 404");
  place_.url = servers_.http("/page");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, find(), "expected an answer of DSpace 7");
}

TEST_F(DspaceTest, ChecksMd5) {
  pcrb_test::writeFile(folder_.file("abc"), "abc");
  requireMd5(folder_.file("abc"), "900150983cd24fb0d6963f7d28e17f72");  // RFC 1321
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, requireMd5(folder_.file("abc"), std::string(32, '0')),
                    "found MD5 900150983cd24fb0d6963f7d28e17f72, expected 0000");
}

TEST_F(DspaceTest, AFileIsFetchedByItemAndNameWhenThePlaceBeforeIsDown) {
  FetchOptions options;
  options.sources = folder_.file("sources.yaml");
  options.logs = folder_.file("logs");
  options.root = folder_.file("root");
  options.policy = policy_;
  options.prepare = false;
  pcrb_test::writeFile(options.sources,
                       "sources:\n  - {data_set: eth, sequence: plain, set: published, kind: log, "
                       "file: eth/plain.zip, url: \"http://127.0.0.1:1/x.zip\",\n     mirrors: "
                       "[{url: \"" +
                           place_.url +
                           "\", dspace_item: item, dspace_name: " + place_.dspace_name + "}]}\n");
  std::ostringstream out;
  EXPECT_TRUE(runFetchTool(options, out)) << out.str();
  EXPECT_EQ(pcrb_test::readFile(folder_.file("logs/eth/plain.zip")),
            pcrb_test::readFile(folder_.file(place_.dspace_name)));
  pcrb_test::writeFile(options.sources,
                       "sources:\n  - {data_set: eth, sequence: plain, set: "
                       "published, kind: log, file: eth/plain.zip, url: \"" +
                           place_.url + "\", dspace_item: item}\n");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, runFetchTool(options, out),
                    "found one of dspace_item and dspace_name, expected both or neither");
}

}  // namespace
}  // namespace pcrb_tools
