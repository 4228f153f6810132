#include "pcrb_core/io/file_hash.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "pcrb_core/error.hpp"
#include "support/temporary_folder.hpp"

namespace {

// Test vector of FIPS 180-2, appendix B.1.
TEST(FileHash, Sha256IsThatOfTheStandard) {
  const pcrb_test::TemporaryFolder folder;
  std::ofstream(folder.file("abc")) << "abc";
  EXPECT_EQ(pcrb::fileSha256(folder.file("abc")),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(FileHash, DependsOnEveryBlockOfTheFile) {
  const pcrb_test::TemporaryFolder folder;
  std::string bytes(3 << 20, 'a');
  std::ofstream(folder.file("a")) << bytes;
  bytes[1 << 20] = 'b';
  std::ofstream(folder.file("b")) << bytes;
  for (const auto hash : {pcrb::fileHash, pcrb::fileSha256}) {
    EXPECT_NE(hash(folder.file("a")), hash(folder.file("b")));
    EXPECT_EQ(hash(folder.file("a")).size(), 64U);
    EXPECT_THROW(hash(folder.file("absent")), pcrb::InvalidFile);
  }
}

}  // namespace
