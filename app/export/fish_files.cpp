// SPDX-License-Identifier: Apache-2.0
#include "app/export/fish_files.h"

#include <filesystem>

#include "platform/camera.h"

namespace nt {

std::string fish_file(const std::string& path, int number) {
  const std::filesystem::path whole(path);
  std::filesystem::path name = whole.stem();
  name += "-" + std::to_string(number);
  name += whole.extension();
  return (whole.parent_path() / name).string();
}

FishFiles::FishFiles(const char* option, std::string path, float scale, int fish_count, const Calibration& calibration)
    : path_(std::move(path)), scale_(scale), calibration_(calibration), files_(static_cast<std::size_t>(fish_count)) {
  if (path_ == "-")
    throw UserError(std::string(option) +
                        " - cannot take several fish; with --all give a file: fish.csv becomes fish-1.csv, "
                        "fish-2.csv, ...",
                    2);
}

void FishFiles::add(int fish, int64_t frame, int64_t time_ns, const FishPose& pose, const OrderStep& order) {
  std::unique_ptr<PoseCsv>& file = files_[static_cast<std::size_t>(fish)];
  if (file == nullptr && !pose.ok()) return;
  if (file == nullptr) file = std::make_unique<PoseCsv>(fish_file(path_, fish + 1), scale_, calibration_);
  file->add(frame, time_ns, pose, order);
}

std::vector<PoseCsv*> FishFiles::files() const {
  std::vector<PoseCsv*> out;
  for (const auto& file : files_)
    if (file != nullptr) out.push_back(file.get());
  return out;
}

void FishFiles::close() {
  for (PoseCsv* file : files()) file->close();
}

std::string FishFiles::written() const {
  std::string names;
  for (std::size_t i = 0; i < files_.size(); ++i)
    if (files_[i] != nullptr) names += (names.empty() ? "" : " ") + fish_file(path_, static_cast<int>(i) + 1);
  return names.empty() ? "no fish" : names;
}

}  // namespace nt
