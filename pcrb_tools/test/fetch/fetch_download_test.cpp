#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "fetch/checksums.hpp"
#include "fetch/download.hpp"
#include "pcrb_core/error.hpp"
#include "support/file_servers.hpp"
#include "support/log_folder.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb_tools {
namespace {

namespace fs = std::filesystem;
using pcrb_test::readFile;
using pcrb_test::writeFile;

std::string someBytes(std::size_t n, unsigned seed) {
  std::string bytes;
  for (std::size_t i = 0; i < n; ++i) {
    seed = seed * 1664525U + 1013904223U;
    bytes += static_cast<char>(seed >> 24);
  }
  return bytes;
}

class DownloadTest : public ::testing::Test {
 protected:
  DownloadTest() : servers_(folder_.path()) {
    writeFile(folder_.file("a.bin"), content_);
    policy_.first_delay = std::chrono::milliseconds(0);
    policy_.attempts = 3;
  }

  void get(const std::string& url, bool google_drive = false) {
    download({url, destination_, google_drive, bytes_, check_}, policy_);
  }

  std::string errorOf(const std::string& url, bool google_drive = false) {
    try {
      get(url, google_drive);
    } catch (const pcrb::Error& error) {
      return error.what();
    }
    return "no error";
  }

  void expectNothingLeft() const {
    EXPECT_FALSE(fs::exists(destination_));
    EXPECT_FALSE(fs::exists(destination_ + ".part"));
    EXPECT_FALSE(fs::exists(destination_ + ".part.from"));
  }

  pcrb_test::TemporaryFolder folder_;
  pcrb_test::FileServers servers_;
  std::string content_ = someBytes(5500, 1);
  std::string destination_ = folder_.file("downloads/a.bin");
  DownloadPolicy policy_;
  std::optional<std::uint64_t> bytes_;
  std::function<void(const std::string&)> check_;
};

TEST_F(DownloadTest, AnEndWithoutALengthIsBelievedWhenItComesTwice) {
  get(servers_.http("/silent/a.bin"));
  EXPECT_EQ(readFile(destination_), content_);
}

TEST_F(DownloadTest, GetsAFileByHttpAndFtpAndLeavesNoPart) {
  for (const std::string& url : {servers_.http("/files/a.bin"), servers_.http("/moved/a.bin"),
                                 servers_.ftp("/files/a.bin")}) {
    get(url);
    EXPECT_EQ(readFile(destination_), content_) << url;
    EXPECT_EQ(pcrb_test::namesIn(folder_.file("downloads")), std::vector<std::string>{"a.bin"});
    fs::remove(destination_);
  }
}

TEST_F(DownloadTest, GoesOnAfterBrokenConnectionsForAsLongAsBytesCome) {
  policy_.attempts = 2;  // the six connections that are needed are more, but each brings bytes
  for (const std::string& url : {servers_.http("/broken/a.bin"), servers_.ftp("/broken/a.bin")}) {
    get(url);
    EXPECT_EQ(readFile(destination_), content_) << url;
    fs::remove(destination_);
  }
}

TEST_F(DownloadTest, GivesUpAfterAttemptsWithoutAByteAndKeepsThePart) {
  writeFile(destination_ + ".part", content_.substr(0, 2000));
  writeFile(destination_ + ".part.from", servers_.http("/stuck/a.bin") + "\n\n");
  const std::string error = errorOf(servers_.http("/stuck/a.bin"));
  EXPECT_NE(error.find("the last of several attempts"), std::string::npos) << error;
  EXPECT_NE(error.find("/stuck/a.bin"), std::string::npos) << error;
  EXPECT_FALSE(fs::exists(destination_));
  EXPECT_EQ(fs::file_size(destination_ + ".part"), 2000U);
}

TEST_F(DownloadTest, GoesOnFromThePartOfAnEarlierRun) {
  // The part differs from the file, which shows that its bytes were kept.
  writeFile(destination_ + ".part", std::string(2000, 'x'));
  writeFile(destination_ + ".part.from", servers_.http("/files/a.bin") + "\n\n");
  get(servers_.http("/files/a.bin"));
  EXPECT_EQ(readFile(destination_), std::string(2000, 'x') + content_.substr(2000));
}

TEST_F(DownloadTest, APartOfAnotherSourceIsBegunAnew) {
  writeFile(destination_ + ".part", std::string(2000, 'x'));
  writeFile(destination_ + ".part.from", "http://elsewhere/a.bin\n\n");
  get(servers_.http("/files/a.bin"));
  EXPECT_EQ(readFile(destination_), content_);
}

TEST_F(DownloadTest, ACompletePartIsNotDownloadedAgain) {
  for (const std::string& url : {servers_.http("/files/a.bin"), servers_.ftp("/files/a.bin")}) {
    writeFile(destination_ + ".part", content_);
    writeFile(destination_ + ".part.from", url + "\n\n");
    get(url);
    EXPECT_EQ(readFile(destination_), content_) << url;
    fs::remove(destination_);
  }
}

TEST_F(DownloadTest, ServerWithoutRangesSendsTheWholeFileAgain) {
  get(servers_.http("/whole/a.bin"));
  EXPECT_EQ(readFile(destination_), content_);
}

TEST_F(DownloadTest, AFileThatChangedOnTheServerIsNotMixed) {
  const std::string changed = someBytes(5500, 2);
  writeFile(folder_.file("a.bin.new"), changed);
  get(servers_.http("/swap/a.bin"));
  EXPECT_EQ(readFile(destination_), changed);
}

TEST_F(DownloadTest, ARestThatWasNotAskedForIsNotAppended) {
  writeFile(destination_ + ".part", content_.substr(0, 2000));
  writeFile(destination_ + ".part.from", servers_.http("/shifted/a.bin") + "\n\n");
  get(servers_.http("/shifted/a.bin"));
  EXPECT_EQ(readFile(destination_), content_);
}

TEST_F(DownloadTest, TriesAgainAfterAServerErrorButNotAfterANo) {
  get(servers_.http("/flaky/a.bin"));
  EXPECT_EQ(readFile(destination_), content_);
  fs::remove(destination_);
  EXPECT_NE(errorOf(servers_.http("/files/absent.bin")).find("status 404"), std::string::npos);
  EXPECT_NE(errorOf(servers_.ftp("/files/absent.bin")), "no error");
  expectNothingLeft();
}

TEST_F(DownloadTest, RefusesAWrongSizeAndAFileThatFailsItsCheck) {
  bytes_ = 5501;
  const std::string error = errorOf(servers_.http("/files/a.bin"));
  EXPECT_NE(error.find("found 5500 bytes, expected 5501"), std::string::npos) << error;
  expectNothingLeft();
  bytes_ = 5500;
  check_ = [](const std::string& path) { throw pcrb::InvalidFile(path, "is no archive"); };
  EXPECT_NE(errorOf(servers_.http("/files/a.bin")).find("is no archive"), std::string::npos);
  expectNothingLeft();
}

TEST_F(DownloadTest, RefusesAnUnreachableServerAndOtherProtocols) {
  EXPECT_NE(errorOf("http://127.0.0.1:1/a.bin").find("several attempts"), std::string::npos);
  EXPECT_NE(errorOf("file://" + folder_.file("a.bin")), "no error");
  expectNothingLeft();
}

TEST_F(DownloadTest, ConfirmsWhatGoogleDriveAsksForAndResumesAfterIt) {
  get(servers_.http("/drive?id=a.bin"), true);
  EXPECT_EQ(readFile(destination_), content_);
}

TEST_F(DownloadTest, APageWithoutConfirmationIsAnErrorThatSaysWhatToDo) {
  const std::string error = errorOf(servers_.http("/quota?id=a.bin"), true);
  EXPECT_NE(error.find("'Quota exceeded'"), std::string::npos) << error;
  EXPECT_NE(error.find("--from"), std::string::npos) << error;
  expectNothingLeft();
}

TEST_F(DownloadTest, TellsHowFarItIs) {
  std::uint64_t last = 0;
  policy_.on_progress = [&](std::uint64_t done, std::uint64_t total) {
    EXPECT_GE(done, last);
    EXPECT_TRUE(total == 0 || total == 5500U) << total;
    last = done;
  };
  get(servers_.http("/broken/a.bin"));
  EXPECT_EQ(last, 5500U);
}

std::string form(const std::string& action) {
  return "<form action=\"" + action + "\"><input name=\"confirm\" value=\"t\"></form>";
}

TEST(Confirmation, LeadsToTheSameHostOrToGoogleOnly) {
  const std::string page = "https://drive.google.com/uc?id=1";
  EXPECT_EQ(confirmedUrl(form("https://drive.usercontent.google.com/download"), page),
            "https://drive.usercontent.google.com/download?confirm=t");
  EXPECT_EQ(confirmedUrl(form("/get?a=1"), page), "https://drive.google.com/get?a=1&confirm=t");
  EXPECT_EQ(confirmedUrl(form("https://evil.example/x"), page), std::nullopt);
  EXPECT_EQ(confirmedUrl(form("https://notgoogle.com/x"), page), std::nullopt);
  EXPECT_EQ(confirmedUrl("<html>no form</html>", page), std::nullopt);
  EXPECT_EQ(confirmedUrl("<form", page), std::nullopt);
}

TEST(Checksums, AreRecordedOnFirstUseAndVerifiedLater) {
  const pcrb_test::TemporaryFolder folder;
  writeFile(folder.file("logs/abc"), "abc");
  const std::string abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
  Checksums(folder.file("logs/SHA256SUMS")).check("x/abc", folder.file("logs/abc"), "");
  EXPECT_EQ(readFile(folder.file("logs/SHA256SUMS")), abc + "  x/abc\n");
  Checksums again(folder.file("logs/SHA256SUMS"));
  EXPECT_EQ(again.find("x/abc"), abc);
  EXPECT_NO_THROW(again.check("x/abc", folder.file("logs/abc"), abc));
  EXPECT_THROW(again.check("x/abc", folder.file("logs/abc"), std::string(64, '0')),
               pcrb::InvalidFile);
  writeFile(folder.file("logs/abc"), "abd");
  EXPECT_THROW(again.check("x/abc", folder.file("logs/abc"), ""), pcrb::InvalidFile);
  const std::string abd = "a52d159f262b2c6ddb724a61840befc36eb30c88877a4030b65cbe86298449c9";
  EXPECT_NO_THROW(again.check("x/abc", folder.file("logs/abc"), abd));  // the list of sources knows
  EXPECT_EQ(Checksums(folder.file("logs/SHA256SUMS")).find("x/abc"), abd);
  writeFile(folder.file("logs/SHA256SUMS"), "no checksum\n");
  EXPECT_THROW(Checksums(folder.file("logs/SHA256SUMS")), pcrb::InvalidFile);
}

}  // namespace
}  // namespace pcrb_tools
