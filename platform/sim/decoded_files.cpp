// SPDX-License-Identifier: Apache-2.0
#include "platform/sim/decoded_files.h"

#include <glob.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/core/version.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <regex>
#include <vector>

#include "platform/camera.h"
#include "platform/sim/quiet_stderr.h"

namespace nt {
namespace {

namespace fs = std::filesystem;

constexpr double kDefaultFps = 25;      // of pictures, and of files that give no rate: FFmpeg's own default
constexpr double kMaxFps = 100000;      // above it a container's rate is a time base, not a rate
constexpr int kMaxFailuresInRow = 256;  // a damaged stretch longer than this counts as the end

void silence_libraries() {
  static const bool done = [] {
    setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 1);  // AV_LOG_QUIET; read once, when the first video opens
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    return true;
  }();
  static_cast<void>(done);
}

// Clockwise quarter turns that show the video upright. OpenCV's own turning is off: 4.6.0, Debian 12's, gives the angle the
// other way round and turns phone videos upside down (opencv issue 22088).
int quarter_turns(double angle_deg) {
  constexpr bool kWrongSign = CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR == 6;
  const long turns = std::lround((kWrongSign ? -angle_deg : angle_deg) / 90.0);
  return static_cast<int>(((turns % 4) + 4) % 4);
}

class VideoSource : public FrameSource {
 public:
  explicit VideoSource(const std::string& path)
      : path_(path), absolute_(fs::absolute(path).string()) {  // absolute: FFmpeg takes "a:b.mp4" for a protocol
    open();
    const double rate = capture_.get(cv::CAP_PROP_FPS);
    fps_ = std::isfinite(rate) && rate > 0 && rate < kMaxFps ? rate : kDefaultFps;
    const double count = capture_.get(cv::CAP_PROP_FRAME_COUNT);
    count_ = std::isfinite(count) && count > 0 && count < 1e12 ? static_cast<int64_t>(count) : -1;
  }
  // A packet that the decoder refuses makes OpenCV's read() fail as the end does; the packets after it still decode.
  bool read(cv::Mat& bgr) override {
    for (int failures = 0; failures <= kMaxFailuresInRow; ++failures) {
      if (!capture_.read(turns_ == 0 ? bgr : lying_)) continue;
      if (turns_ != 0) cv::rotate(lying_, bgr, turns_ - 1);  // cv::RotateFlags are in this order
      index_ += failures + 1;
      return true;
    }
    return false;
  }
  void rewind() override {  // seeking to 0 is inexact in some containers
    open();
    index_ = -1;
  }
  bool seek(int64_t index) override {
    if (go_to(index)) return true;
    open();  // once it has seen the end, OpenCV's decoder goes nowhere else
    return go_to(index);
  }
  double fps() const override { return fps_; }
  int64_t frame_count() const override { return count_; }

 private:
  bool go_to(int64_t index) {
    if (index < 0 || !capture_.set(cv::CAP_PROP_POS_FRAMES, static_cast<double>(index))) return false;
    index_ = std::llround(capture_.get(cv::CAP_PROP_POS_FRAMES)) - 1;  // past the end it stays there
    return index_ + 1 == index;
  }
  void open() {
    if (!capture_.open(absolute_, cv::CAP_FFMPEG)) {
      throw UserError(
          path_ +
          ": not a video or picture that can be read (another kind of file, or cut short while it was recorded)");
    }
    capture_.set(cv::CAP_PROP_ORIENTATION_AUTO, 0);
    turns_ = quarter_turns(capture_.get(cv::CAP_PROP_ORIENTATION_META));
  }

  std::string path_, absolute_;
  cv::VideoCapture capture_;
  cv::Mat lying_;
  int turns_ = 0;
  double fps_ = kDefaultFps;
  int64_t count_ = -1;
};

class PictureSource : public FrameSource {
 public:
  explicit PictureSource(std::vector<std::string> files) : files_(std::move(files)) {}
  bool read(cv::Mat& bgr) override {
    while (index_ + 1 < static_cast<int64_t>(files_.size())) {
      ++index_;
      if (decode(files_[static_cast<std::size_t>(index_)], bgr)) return true;
    }
    return false;
  }
  void rewind() override { index_ = -1; }
  bool seek(int64_t index) override {
    if (index < 0 || index >= frame_count()) return false;
    index_ = index - 1;
    return true;
  }
  double fps() const override { return kDefaultFps; }
  int64_t frame_count() const override { return static_cast<int64_t>(files_.size()); }

 private:
  static bool decode(const std::string& file, cv::Mat& bgr) {
    const QuietStderr quiet;
    try {
      bgr = cv::imread(file, cv::IMREAD_COLOR);
    } catch (const cv::Exception&) {  // OpenCV's own limit on the size of a picture
      return false;
    }
    return !bgr.empty();
  }
  std::vector<std::string> files_;
};

bool is_picture(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error) && fs::file_size(file, error) > 0 && cv::haveImageReader(file.string());
}

// frame_2 before frame_10: runs of digits compare as numbers.
bool natural_less(const std::string& a, const std::string& b) {
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (!digit(a[i]) || !digit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
      continue;
    }
    const auto number = [&](const std::string& s, std::size_t& at) {
      while (at < s.size() && s[at] == '0') ++at;
      const std::size_t start = at;
      while (at < s.size() && digit(s[at])) ++at;
      return s.substr(start, at - start);
    };
    const std::string x = number(a, i), y = number(b, j);
    if (x.size() != y.size()) return x.size() < y.size();
    if (x != y) return x < y;
  }
  if (a.size() - i != b.size() - j) return a.size() - i < b.size() - j;
  return a < b;  // the same but for leading zeros
}

std::vector<std::string> pictures_in(const fs::path& folder, const std::regex* pattern) {
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? fs::path(".") : folder, error)) {
    const std::string name = entry.path().filename().string();
    const bool wanted = pattern != nullptr ? std::regex_match(name, *pattern) : is_picture(entry.path());
    if (wanted) files.push_back(entry.path().string());
  }
  return files;
}

std::vector<std::string> glob_pictures(const std::string& pattern) {
  std::vector<std::string> files;
  glob_t found{};
  if (glob(pattern.c_str(), 0, nullptr, &found) == 0) files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  globfree(&found);
  return files;
}

// frame_%04d.png -> frame_([0-9]{4,}).png, whatever number the sequence starts with.
std::vector<std::string> numbered_pictures(const fs::path& path) {
  const std::string name = path.filename().string();
  static const std::regex conversion("%(0?)([0-9]*)d");
  std::smatch match;
  if (!std::regex_search(name, match, conversion)) return {};
  const auto literal = [](const std::string& text) {
    static const std::regex special(R"([.^$|()\[\]{}*+?\\])");
    return std::regex_replace(text, special, R"(\$&)");
  };
  const std::string digits =
      match[2].length() > 0 && match[1].length() > 0 ? "[0-9]{" + match[2].str() + ",}" : "[0-9]+";
  const std::regex wanted(literal(match.prefix()) + digits + literal(match.suffix()));
  return pictures_in(path.parent_path(), &wanted);
}

std::unique_ptr<FrameSource> open_pictures(std::vector<std::string> files, const std::string& problem) {
  if (files.empty()) throw UserError(problem);
  std::sort(files.begin(), files.end(), natural_less);
  return std::make_unique<PictureSource>(std::move(files));
}

}  // namespace

std::unique_ptr<FrameSource> open_decoded_files(const std::string& path) {
  silence_libraries();
  std::error_code error;
  if (fs::is_directory(path, error)) {
    return open_pictures(pictures_in(path, nullptr),
                         path + ": there is no picture in this folder; give one that holds .png or .jpg frames");
  }
  if (!fs::exists(path, error)) {
    const std::string nothing = path + ": no picture matches this pattern; check the path";
    if (path.find('%') != std::string::npos) return open_pictures(numbered_pictures(path), nothing);
    if (path.find_first_of("*?[") != std::string::npos) return open_pictures(glob_pictures(path), nothing);
    throw UserError(path + ": no such file; check the path", 3);
  }
  if (access(path.c_str(), R_OK) != 0) throw UserError(path + ": permission denied; make it readable");
  if (fs::is_regular_file(path, error) && fs::file_size(path, error) == 0) {
    throw UserError(path + ": the file is empty; record it again");
  }
  const std::string extension = fs::path(path).extension().string();
  const bool jpeg_stream = extension == ".mjpeg" || extension == ".mjpg";  // begins as one JPEG picture does
  if (!jpeg_stream && is_picture(path)) return open_pictures({path}, path);
  return std::make_unique<VideoSource>(path);
}

}  // namespace nt
