#include "fetch/sources.hpp"

#include <gtest/gtest.h>

#include "pcrb_core/error.hpp"
#include "support/log_folder.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

using pcrb_test::writeFile;

TEST(Sources, OfThePackageCoverAllPublishedSequences) {
  const auto sources = readSources(PCRB_TOOLS_FOLDER "/config/datasets.yaml");
  std::size_t problems = 0;
  for (const Source& source : sources) problems += source.kind == SourceKind::kProblems ? 1 : 0;
  EXPECT_EQ(problems, 30U);  // 15 lists for each kind
}

TEST(Sources, RejectsMistakesWithTheirLine) {
  const pcrb_test::TemporaryFolder folder;
  const std::string good =
      "{data_set: d, sequence: s, set: both, kind: log, file: f, url: \"http://x\"}";
  const auto error_of = [&](const std::string& entry) {
    writeFile(folder.file("s.yaml"), "sources:\n  - " + good + "\n  - " + entry + "\n");
    try {
      readSources(folder.file("s.yaml"));
    } catch (const pcrb::InvalidFile& error) {
      return std::string(error.what()).substr(folder.path().size() + 1);
    }
    return std::string("accepted");
  };
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string entry = good;
    entry.replace(entry.find("file: f"), 7, "file: g");
    entry.replace(entry.find(from), from.size(), to);
    return entry;
  };
  EXPECT_EQ(error_of(good), "s.yaml:3: found f again, expected every file once");
  EXPECT_EQ(error_of(with("file: g", "file: ../g")),
            "s.yaml:3: found '../g', expected a name below its folder");
  EXPECT_EQ(error_of(with("data_set: d", "data_set: /d")),
            "s.yaml:3: found '/d', expected a name below its folder");
  EXPECT_EQ(error_of(with("http://x", "file:///etc/passwd")),
            "s.yaml:3: found 'file:///etc/passwd', expected an address of http, https or ftp");
  EXPECT_EQ(error_of(with("kind: log", "kind: tape")),
            "s.yaml:3: found 'tape', expected cloud, clouds, log, problems");
  EXPECT_EQ(error_of(with("kind: log", "colour: red, kind: log")),
            "s.yaml:3: found 'colour', expected a known key");
  EXPECT_EQ(error_of(with("kind: log", "kind: log, bytes: many")),
            "s.yaml:3: found 'many', expected a number of bytes");
  EXPECT_EQ(error_of(with("kind: log", "kind: log, sha256: abc")),
            "s.yaml:3: found 'abc', expected 64 hexadecimal digits");
  EXPECT_EQ(error_of(with("kind: log, ", "")),
            "s.yaml:3: found no kind, expected data_set, sequence, set, kind and file");
  EXPECT_EQ(error_of(with("url: \"http://x\"", "by_hand: yes, url: \"http://x\"")),
            "s.yaml:3: found both, expected either url or by_hand");
  EXPECT_EQ(error_of(with("kind: log", "kind: log, needs: d/t")),
            "s.yaml:3: found 'd/t', expected <data set>/<sequence> of this list");
  EXPECT_EQ(error_of(with("kind: log", "kind: log, mirrors: [{bytes: 1}]")),
            "s.yaml:3: found no url, expected one");
  EXPECT_EQ(error_of(with("kind: log", "kind: log, mirrors: x")),
            "s.yaml:3: found no list, expected a list of maps with a url");
  EXPECT_NE(error_of("[").find("expected YAML"), std::string::npos);
}

}  // namespace
}  // namespace pcrb_tools
