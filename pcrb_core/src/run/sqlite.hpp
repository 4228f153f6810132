#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace pcrb {

/// A connection to an SQLite database; every failure is a StoreError that names the file.
class Database {
 public:
  /// @param flags  SQLITE_OPEN_… of sqlite3_open_v2.
  /// @param uri    what is opened where it is not the path itself (`file:…?immutable=1`).
  Database(const std::string& path, int flags, const std::string& uri = {});

  /// Runs statements that give no rows.
  /// @param action  for the message: "cannot ACTION".
  void execute(const char* sql, const char* action);

  /// First column of the first row, as text; empty where there is no row.
  std::string value(const std::string& sql, const char* action);

  sqlite3* handle() const { return handle_.get(); }
  const std::string& path() const { return path_; }

  /// @throws StoreError  always: file, action, SQLite's and the system's reason.
  [[noreturn]] void fail(const std::string& action) const;

 private:
  struct Close {
    void operator()(sqlite3* handle) const { sqlite3_close_v2(handle); }
  };

  std::string path_;
  std::unique_ptr<sqlite3, Close> handle_;
};

/// A prepared statement. Parameters and columns count from 0, in order; each bind… takes the next.
class Statement {
 public:
  /// @param action  for messages: "cannot ACTION".
  Statement(Database& database, const std::string& sql, std::string action);

  /// Forgets rows and parameters; also after a failure.
  void reset();

  void bind(std::string_view text);
  void bind(double value);
  void bind(std::int64_t value);
  void bindNull();

  template <typename T>
  void bind(const std::optional<T>& value) {
    if (value) {
      bind(*value);
    } else {
      bindNull();
    }
  }

  /// The next row; false behind the last one.
  bool step();

  /// Resets, takes the row's parameters from `bind_all`, runs, resets.
  template <typename BindAll>
  void run(const BindAll& bind_all) {
    reset();
    bind_all(*this);
    while (step()) {
    }
    reset();
  }

  int columns() const { return sqlite3_column_count(handle_.get()); }
  bool isNull(int column) const { return type(column) == SQLITE_NULL; }
  int type(int column) const { return sqlite3_column_type(handle_.get(), column); }
  std::string name(int column) const { return sqlite3_column_name(handle_.get(), column); }
  std::string text(int column) const;
  double real(int column) const { return sqlite3_column_double(handle_.get(), column); }
  std::int64_t integer(int column) const { return sqlite3_column_int64(handle_.get(), column); }

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* handle) const { sqlite3_finalize(handle); }
  };

  void check(int code) const;

  Database* database_;
  std::string action_;
  std::unique_ptr<sqlite3_stmt, Finalize> handle_;
  int next_parameter_ = 1;  // SQLite counts parameters from 1
};

/// A transaction that is rolled back unless commit() was reached.
class Transaction {
 public:
  Transaction(Database& database, const char* action);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;

  void commit();

 private:
  Database& database_;
  const char* action_;
  bool open_ = true;
};

}  // namespace pcrb
