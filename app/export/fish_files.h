// SPDX-License-Identifier: Apache-2.0
// One pose CSV a fish: FILE.csv -> FILE-1.csv, FILE-2.csv, ... by the numbers that capture gives them.
//
// A fish's file is made when it has its first pose and starts with that frame; from then on it has a row for every frame.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/export/pose_csv.h"

namespace nt {

// `number` from 1: "out/fish.csv" -> "out/fish-2.csv".
std::string fish_file(const std::string& path, int number);

class FishFiles {
 public:
  // Throws UserError for standard output: several files do not fit into it.
  FishFiles(const char* option, std::string path, float scale, int fish_count, const Calibration& calibration = {});
  // `fish` from 0; `order` is core's, of this pose.
  void add(int fish, int64_t frame, int64_t time_ns, const FishPose& pose, const OrderStep& order = {});
  std::vector<PoseCsv*> files() const;  // those that there are
  void close();
  std::string written() const;  // "fish-1.csv fish-2.csv", or "no fish"

 private:
  std::string path_;
  float scale_;
  Calibration calibration_;
  std::vector<std::unique_ptr<PoseCsv>> files_;
};

}  // namespace nt
