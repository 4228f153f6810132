#pragma once

#include <string>

#include "evaluation/sqlite.hpp"

namespace pcrb {

/// Opens a results store, makes it where missing or empty, and sees to it that commits last.
/// @throws StoreError  naming the file and what it is instead, or why it cannot be written.
Database openStoreForWriting(const std::string& path);

/// Opens a results store that exists, also beside an active writer and on a read-only disk.
/// @throws StoreError  naming the file and what it is instead, or why it cannot be read.
Database openStoreForReading(const std::string& path);

}  // namespace pcrb
