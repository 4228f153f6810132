#include "fetch/dspace.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <sstream>

#include "fetch/fetch_tool.hpp"
#include "pcrb_core/error.hpp"
#include "pcrb_core/random.hpp"
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

/// What a repository says of an item with one file, by address.
std::map<std::string, std::string> wholeAnswers() {
  return {
      {"http://repository/core/items/item/bundles",
       R"({"_embedded": {"bundles": [{"uuid": "small", "name": "THUMBNAIL"}, {"uuid": "files", "name": "ORIGINAL"}]}})"},
      {"http://repository/core/bundles/files/bitstreams",
       R"({"_embedded": {"bitstreams": [{"name": "other.zip"}]},)"
       R"( "_links": {"next": {"href": "http://repository/page1"}}})"},
      {"http://repository/page1",
       R"({"_embedded": {"bitstreams": [{"name": "a.zip", "sizeBytes": 5000, "checkSum":)"
       R"( {"checkSumAlgorithm": "MD5", "value": "900150983cd24fb0d6963f7d28e17f72"},)"
       R"( "_links": {"content": {"href": "http://repository/content"}}}]}})"}};
}

Place askFor(const std::map<std::string, std::string>& answers) {
  Place place;
  place.url = "http://repository";
  place.dspace_item = "item";
  place.dspace_name = "a.zip";
  return findInDspace(place, [&](const std::string& url) {
    const auto found = answers.find(url);
    if (found == answers.end()) throw pcrb::InvalidFile(url, "no such page");
    return found->second;
  });
}

std::string damagedAnswer(std::string text, pcrb::Random& random) {
  if (random.uniform(0, 1) < 0.1) return text.substr(0, random.below(text.size()));
  for (std::uint64_t i = 0; i <= random.below(4); ++i) {
    const std::size_t at = random.below(text.size());
    if (random.uniform(0, 1) < 0.5) {
      text[at] = static_cast<char>(random.below(256));
    } else {  // a part of it again
      text.insert(at, text.substr(random.below(text.size()), random.below(30)));
    }
  }
  return text;
}

TEST(DspaceAnswers, DamagedOnesAreAPlaceThatCouldBeMeantOrRefused) {
  ASSERT_EQ(askFor(wholeAnswers()).bytes, 5000U);
  pcrb::Random random(23);
  int found = 0;
  constexpr int kDamagedAnswers = 3000;
  for (int i = 0; i < kDamagedAnswers; ++i) {
    auto answers = wholeAnswers();
    for (auto& [url, answer] : answers) {
      if (random.uniform(0, 1) < 0.5) answer = damagedAnswer(answer, random);
    }
    try {
      const Place place = askFor(answers);
      EXPECT_TRUE(place.md5.empty() || place.md5.size() == 32) << place.md5;
      ++found;
    } catch (const pcrb::Error&) {
    }
  }
  EXPECT_GT(found, 0);
  EXPECT_LT(found, kDamagedAnswers);
}

TEST(DspaceAnswers, WhatIsNoSizeOrChecksumOrWithoutAnEndIsRefused) {
  const auto expect = [](const std::string& what, const std::string& instead, const char* error) {
    auto answers = wholeAnswers();
    std::string& answer = answers.at("http://repository/page1");
    answer.replace(answer.find(what), what.size(), instead);
    PCRB_EXPECT_ERROR(pcrb::InvalidFile, askFor(answers), error);
  };
  expect("5000", "-1", "found sizeBytes -1, expected a number of bytes");
  expect("5000", "1e99", "expected a number of bytes");
  expect("900150983cd24fb0d6963f7d28e17f72", "abc", "found MD5 'abc', expected 32 hexadecimal");
  expect("[{\"name\"", std::string(100000, '[') + "{\"name\"", "JSON of great depth");
  auto round = wholeAnswers();
  round.at("http://repository/page1") =
      R"({"_links": {"next": {"href": "http://repository/page1"}}})";
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, askFor(round), "found the files other.zip, expected a.zip");
}

TEST_F(DspaceTest, AnAnswerWithoutAnEndIsGivenUp) {
  place_.url = servers_.http("/endless");
  PCRB_EXPECT_ERROR(pcrb::InvalidFile, find(), "found more than 4194304 bytes");
  EXPECT_FALSE(std::filesystem::exists(folder_.file("answer.json.part")));
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
