// SPDX-License-Identifier: Apache-2.0
// export --to png, sprite, mp4 and play --out, read back by OpenCV.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "app/take/fish_shape.h"
#include "app/take/take.h"
#include "core/motion/property.h"
#include "tests/app/run_binary.h"

namespace nt {
namespace {

using Json = nlohmann::json;
const std::string kCarp = " --character " NEONTETRA_ASSETS "/characters/carp.png";
constexpr int kWidth = 480, kHeight = 270, kFrames = 40;
constexpr float kLength = 100;

// Two fish that swim to the right and beat; the second comes with frame 10 and is lost from frame 30 on.
void write_take(const std::string& path) {
  TakeInfo info;
  info.name = "two", info.fps = 20;
  info.source_width = info.width = kWidth, info.source_height = info.height = kHeight;
  Take take = Take::create(path, info);
  FishShape shape;
  shape.head_len = shape.tail_len = 5;
  for (float& len : shape.up_len) len = 10;
  for (float& len : shape.low_len) len = 4;
  std::vector<TakeFrame> frames;
  for (int i = 0; i < kFrames; ++i) {
    for (int fish = 0; fish < 2; ++fish) {
      if (fish == 1 && (i < 10 || i >= 30)) continue;
      TakeFrame frame;
      frame.frame = i, frame.fish = fish, frame.init_len = kLength;
      Motion& m = frame.motion = straight_motion(3, 15);
      m.status = PoseStatus::ok, m.confidence = {1, 1, 1, 0, 0, 1}, m.time_ns = i * 50'000'000LL;
      m.centre = {120 + 4.0f * static_cast<float>(i), fish == 0 ? 80.0f : 190.0f};
      for (int b = 0; b < m.l_num; ++b)
        m.low_axis_angle[b] += 0.03f * static_cast<float>(b) * std::sin(0.6f * static_cast<float>(i));
      frame.pose = pose_of(m, shape);
      frames.push_back(frame);
    }
  }
  take.append(frames);
  take.close();
}

class TakePictures : public testing::Test {
 protected:
  TakePictures() { write_take(file("a.take")); }
  std::string file(const std::string& name) const { return dir_ / name; }
  Outcome export_to(const std::string& format, const std::string& out, const std::string& more = "") const {
    return neontetra("export " + file("a.take") + kCarp + " --to " + format + " --out " + file(out) + " " + more);
  }

 private:
  TempDir dir_;
};

int alpha_at(const cv::Mat& rgba, int x, int y) { return rgba.at<cv::Vec4b>(y, x)[3]; }

TEST_F(TakePictures, APngSeriesIsTransparentWhereNobodyIs) {
  const Outcome run = export_to("png", "f.png", "--range 5:34");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_FALSE(std::filesystem::exists(file("f-00030.png")));
  for (int i = 0; i < 30; ++i) {
    const cv::Mat rgba = cv::imread(file(cv::format("f-%05d.png", i)), cv::IMREAD_UNCHANGED);
    ASSERT_EQ(rgba.channels(), 4);
    ASSERT_EQ(rgba.size(), cv::Size(kWidth, kHeight));
    const int frame = i + 5, x = 120 + 4 * frame;
    EXPECT_EQ(alpha_at(rgba, x, 80), 255) << frame;
    EXPECT_EQ(alpha_at(rgba, 2, 2), 0);
    EXPECT_EQ(alpha_at(rgba, x, 135), 0);
    if (frame < 30) {
      EXPECT_EQ(alpha_at(rgba, x, 190), frame < 10 ? 0 : 255) << frame;
    }
    // The carp is nowhere black: its edge is not darkened by what is not there.
    int partly = 0;
    for (const cv::Vec4b& p : cv::Mat_<cv::Vec4b>(rgba)) {
      if (p[3] < 40 || p[3] == 255) continue;
      ++partly;
      EXPECT_GT(std::max({p[0], p[1], p[2]}), 60);
    }
    EXPECT_GT(partly, 20);
  }
}

TEST_F(TakePictures, ASeriesThatIsStoppedSaysHowFarItCame) {
  const Outcome run = export_to("png", "f.png",
                                "--rate 200 --json " + file("f.json") + " & p=$!; until [ -e " + file("f-00002.png") +
                                    " ]; do sleep 0.02; done; kill $p; wait $p");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("stopped before its end"), std::string::npos) << run.err;
  const int frames = Json::parse(read_text(file("f.json")))["frames"];
  EXPECT_LT(frames, 390);
  EXPECT_FALSE(cv::imread(file(cv::format("f-%05d.png", frames - 1)), cv::IMREAD_UNCHANGED).empty());
  EXPECT_FALSE(std::filesystem::exists(file(cv::format("f-%05d.png", frames))));
}

TEST_F(TakePictures, ASpriteSheetHasItsFishInEveryCell) {
  const Outcome run = export_to("sprite", "s.png", "--range 4:24 --length 150 --json -");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const cv::Mat sheet = cv::imread(file("s.png"), cv::IMREAD_UNCHANGED);
  const Json json = Json::parse(read_text(file("s.json")));
  ASSERT_EQ(sheet.channels(), 4);
  EXPECT_EQ(json["meta"]["image"], "s.png");
  EXPECT_EQ(json["meta"]["size"]["w"], sheet.cols);
  EXPECT_EQ(json["meta"]["size"]["h"], sheet.rows);
  EXPECT_EQ(json["meta"]["fps"], 20);
  ASSERT_EQ(json["frames"].size(), 21u);
  for (std::size_t i = 0; i < 21; ++i) {
    const Json& frame = json["frames"][i];
    const Json& at = frame["frame"];
    const cv::Rect cell(at["x"], at["y"], at["w"], at["h"]);
    ASSERT_EQ(cell & cv::Rect(0, 0, sheet.cols, sheet.rows), cell);
    EXPECT_EQ(frame["duration"], 50);
    EXPECT_NEAR(frame["path"]["x"].get<double>(), 120 + 4.0 * static_cast<double>(i + 4), 1e-3);
    EXPECT_NEAR(frame["path"]["rotation"].get<double>(), 1.5707963, 1e-5);  // it swims to the right
    cv::Mat alpha;
    cv::extractChannel(sheet(cell), alpha, 3);
    const int x = static_cast<int>(frame["pivot"]["x"].get<double>() * cell.width);
    const int y = static_cast<int>(frame["pivot"]["y"].get<double>() * cell.height);
    EXPECT_EQ(alpha.at<uint8_t>(y, x), 255) << i;
    for (const cv::Mat& rim : {alpha.row(0), alpha.row(cell.height - 1), alpha.col(0), alpha.col(cell.width - 1)})
      EXPECT_EQ(cv::countNonZero(rim), 0) << i;
    cv::Mat rows;
    cv::reduce(alpha, rows, 1, cv::REDUCE_MAX);
    // Head up; 150 from the head to the notch of the tail, past which its lobes reach.
    EXPECT_NEAR(cv::countNonZero(rows), 168, 6) << i;
  }
  const Outcome large = export_to("sprite", "s.png", "--length 9000");
  EXPECT_EQ(large.exit_code, 2);
  EXPECT_NE(large.err.find("lower --rate"), std::string::npos) << large.err;
}

TEST_F(TakePictures, AVideoHasAllFishAndItsOwnRate) {
  ASSERT_EQ(export_to("mp4", "v.mp4", "--rate 40 --backdrop '#00ff00'").exit_code, 0);
  cv::VideoCapture video(file("v.mp4"));
  EXPECT_EQ(video.get(cv::CAP_PROP_FPS), 40);
  EXPECT_EQ(video.get(cv::CAP_PROP_FRAME_COUNT), 79);
  cv::Mat frame;
  for (int i = 0; i <= 40; ++i) ASSERT_TRUE(video.read(frame));
  EXPECT_EQ(frame.size(), cv::Size(kWidth, kHeight));
  const auto green = [&](int x, int y) {
    const cv::Vec3b p = frame.at<cv::Vec3b>(y, x);
    return p[1] > 200 && p[0] < 60 && p[2] < 60;
  };
  EXPECT_TRUE(green(20, 20));
  EXPECT_FALSE(green(200, 80));  // frame 20 of the take
  EXPECT_FALSE(green(200, 190));
}

TEST_F(TakePictures, PlayMakesAFilmAtAnySpeed) {
  const std::string play = "play " + file("a.take") + kCarp + " --out ";
  ASSERT_EQ(neontetra(play + file("p.mp4") + " --speed 0.5").exit_code, 0);
  cv::VideoCapture slow(file("p.mp4"));
  EXPECT_EQ(slow.get(cv::CAP_PROP_FPS), 60);
  EXPECT_EQ(slow.get(cv::CAP_PROP_FRAME_COUNT), 39 * 6 + 1);
  ASSERT_EQ(neontetra(play + file("q.mp4") + " --fish 1 --loop --range 10:29 --rate 20").exit_code, 0);
  EXPECT_EQ(cv::VideoCapture(file("q.mp4")).get(cv::CAP_PROP_FRAME_COUNT), 20);
  EXPECT_EQ(neontetra(play + file("r.mp4") + " --fish 1 --range 0:5").exit_code, 1);  // not there yet
  EXPECT_EQ(neontetra(play + file("r.mp4") + " --fish 2").exit_code, 2);
  EXPECT_EQ(neontetra(play + file("r.mp4") + " --backdrop camera").exit_code, 2);
  EXPECT_EQ(neontetra("play " + file("a.take") + " --out " + file("r.mp4")).exit_code, 2);
}

TEST_F(TakePictures, PlayOpensAWindow) {
  if (std::system("command -v xvfb-run >/dev/null 2>&1 && command -v xdotool >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "no xvfb-run or xdotool";
  std::ofstream(file("script.sh")) << "timeout 60 " NEONTETRA_BINARY " play " << file("a.take") << kCarp << " --loop 2>"
                                   << file("err")
                                   << " &\n"
                                      "program=$!\n"
                                      "window=$(timeout 20 xdotool search --sync --onlyvisible --name '^neontetra$')\n"
                                      "xdotool windowfocus $window\n"
                                      "sleep 1\n"
                                      "xdotool key space Left Right c i\n"
                                      "sleep 0.5\n"
                                      "xdotool key q\nwait $program\n";
  const std::string run = "xvfb-run -a -s '-screen 0 1600x900x24' sh " + file("script.sh") + " >/dev/null 2>&1";
  EXPECT_EQ(std::system(run.c_str()), 0) << read_text(file("err"));
  // Without --loop the window closes itself at the end: two seconds of take.
  const std::string once = "xvfb-run -a -s '-screen 0 1600x900x24' timeout 20 " NEONTETRA_BINARY " play " +
                           file("a.take") + kCarp + " 2>" + file("err") + " >/dev/null";
  EXPECT_EQ(std::system(once.c_str()), 0) << read_text(file("err"));
}

}  // namespace
}  // namespace nt
