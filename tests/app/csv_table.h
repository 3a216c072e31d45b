// SPDX-License-Identifier: Apache-2.0
// Reads a pose CSV back, the way a user's script would.
#pragma once
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace nt {

class CsvTable {
 public:
  explicit CsvTable(const std::string& path) {
    std::ifstream file(path);
    std::string line;
    std::getline(file, header_);
    const std::vector<std::string> names = split(header_);
    for (std::size_t i = 0; i < names.size(); ++i) columns_[names[i]] = i;
    while (std::getline(file, line)) rows_.push_back(split(line));
  }
  const std::string& header() const { return header_; }
  std::size_t columns() const { return columns_.size(); }
  std::size_t rows() const { return rows_.size(); }
  std::size_t cells(std::size_t row) const { return rows_[row].size(); }
  const std::string& text(std::size_t row, const std::string& column) const {
    return rows_[row].at(columns_.at(column));
  }
  std::optional<double> number(std::size_t row, const std::string& column) const {
    const std::string& cell = text(row, column);
    return cell.empty() ? std::nullopt : std::optional<double>(std::stod(cell));
  }

 private:
  static std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> cells(1);
    for (const char c : line) {
      if (c == ',') cells.emplace_back();
      else cells.back() += c;
    }
    return cells;
  }
  std::string header_;
  std::map<std::string, std::size_t> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace nt
