#include "pcrb_core/io/file_lock.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "pcrb_core/error.hpp"
#include "support/temporary_folder.hpp"

namespace pcrb {
namespace {

TEST(FileLock, IsHeldByOneAtATimeAndNamesItToOthers) {
  const pcrb_test::TemporaryFolder folder;
  const std::string path = folder.file("a.lock");
  {
    const FileLock first(path);
    EXPECT_TRUE(first.isHeld());
    EXPECT_EQ(first.holder(), "");
    const FileLock second(path);
    EXPECT_FALSE(second.isHeld());
    EXPECT_EQ(second.holder().find("process " + std::to_string(getpid()) + " on "), 0U);
  }
  EXPECT_TRUE(FileLock(path).isHeld());
}

TEST(FileLock, RefusesAFileThatCannotBeMade) {
  EXPECT_THROW(FileLock("/no/such/folder/a.lock"), InvalidFile);
}

}  // namespace
}  // namespace pcrb
