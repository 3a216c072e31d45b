// SPDX-License-Identifier: Apache-2.0
// SQLite, as far as takes need it: a connection and prepared statements that cannot leak.
//
// Errors are DatabaseError with SQLite's code; the take files (take.h) turn them into one line for the user.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

struct sqlite3;
struct sqlite3_stmt;

namespace nt {

struct DatabaseError : std::runtime_error {
  int code;  // SQLITE_FULL, SQLITE_BUSY, ...
  DatabaseError(int code_, const std::string& message) : std::runtime_error(message), code(code_) {}
};

class Statement {
 public:
  // Parameters from 1, columns from 0.
  Statement& bind(int index, int64_t value);
  Statement& bind(int index, double value);
  Statement& bind(int index, const std::string& text);
  Statement& bind(int index, std::span<const std::byte> blob);
  bool step();  // false: no further row
  void run();   // to the end, and ready for the next time
  void reset();

  int64_t integer(int column) const;
  double real(int column) const;
  std::string text(int column) const;
  std::span<const std::byte> blob(int column) const;  // until the next step

 private:
  friend class Database;
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  explicit Statement(sqlite3_stmt* statement) : statement_(statement) {}
  void check(int code) const;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

class Database {
 public:
  enum class Mode : uint8_t { read, write, create };
  Database(const std::string& path, Mode mode);
  void execute(const char* sql);
  Statement prepare(const char* sql);
  int64_t pragma(const char* name);

 private:
  struct Close {
    void operator()(sqlite3* connection) const;
  };
  std::unique_ptr<sqlite3, Close> connection_;
};

}  // namespace nt
