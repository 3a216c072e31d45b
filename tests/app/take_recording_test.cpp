// SPDX-License-Identifier: Apache-2.0
// What capture and live record into takes: several fish, thumbnails, the camera's pictures, the seconds before the key.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "app/take/take.h"
#include "tests/app/csv_table.h"
#include "tests/app/run_binary.h"

namespace nt {
namespace {

using Json = nlohmann::json;
const std::string kCrossing = "capture -c sim:scene=crossing,seed=1,size=480x272,frames=150 --background vibe ";

TEST(TakeRecording, HoldsEveryFishAsTheTablesDo) {
  const TempDir dir;
  const Outcome run =
      neontetra(kCrossing + "--all --max-fish 3 --csv " + (dir / "fish.csv") + " --take " + (dir / "a.take"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  Take take = Take::open(dir / "a.take", Take::Access::read);
  ASSERT_GE(take.fish().size(), 2u);
  const double scale = static_cast<double>(take.info().source_width) / take.info().width;
  int compared = 0;
  for (const int fish : take.fish()) {
    const std::vector<TakeFrame> frames = take.frames(fish);
    EXPECT_EQ(frames.size(), 150u);
    const std::string table = dir / ("fish-" + std::to_string(fish + 1) + ".csv");
    if (!std::filesystem::exists(table)) continue;  // the first fish is in the take from the start
    const CsvTable csv(table);
    for (std::size_t row = 0; row < csv.rows(); ++row) {
      const TakeFrame& frame = frames[static_cast<std::size_t>(csv.number(row, "frame").value())];
      ASSERT_TRUE(frame.recorded);
      EXPECT_EQ(csv.text(row, "status"), to_string(frame.pose.status)) << fish << " " << frame.frame;
      if (!frame.pose.ok()) continue;
      ++compared;
      EXPECT_NEAR(csv.number(row, "centre_x").value(), (static_cast<double>(frame.pose.centre.x) + 0.5) * scale - 0.5,
                  2e-3);
    }
  }
  EXPECT_GT(compared, 60);
}

TEST(TakeRecording, KeepsThumbnailsAndTheVideo) {
  const TempDir dir;
  const std::string take = dir / "a.take";
  const Outcome run = neontetra(kCrossing + "--keep-video --scale-points 10,10,110,10 --scale-mm 50 --take " + take);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("a.take: 5.0 s, 150 frames, 1 fish, with a.take.mkv"), std::string::npos) << run.err;
  cv::VideoCapture video(take + ".mkv");
  cv::Mat picture, last;
  int pictures = 0;
  for (; video.read(picture); ++pictures) picture.copyTo(last);
  EXPECT_EQ(pictures, 150);
  EXPECT_EQ(last.size(), cv::Size(480, 272));
  Json json = Json::parse(neontetra("takes --json " + take).out)[0];
  EXPECT_EQ(json["video"]["file"], take + ".mkv");
  EXPECT_EQ(json["video"]["there"], true);
  EXPECT_EQ(json["video"]["first_frame"], 0);
  EXPECT_NEAR(json["px_per_mm"].get<double>(), 2, 1e-6);
  // Thumbnails: OpenCV reads them, and they look like the film.
  std::vector<Thumbnail> thumbnails = Take::open(take, Take::Access::read).thumbnails();
  ASSERT_GE(thumbnails.size(), 2u);
  for (const Thumbnail& thumbnail : thumbnails) {
    const cv::Mat small = cv::imdecode(thumbnail.bmp, cv::IMREAD_COLOR);
    ASSERT_EQ(small.size(), cv::Size(128, 72));
    EXPECT_NEAR(cv::mean(small)[0], cv::mean(last)[0], 6);
    EXPECT_NEAR(cv::mean(small)[2], cv::mean(last)[2], 6);
  }
  EXPECT_EQ(neontetra("takes " + take + " --thumbnails " + (dir / "t.png")).exit_code, 0);
  EXPECT_EQ(cv::imread(dir / "t.png").cols, 128 * static_cast<int>(thumbnails.size()));
  // A trim moves both along; the bin takes the film with the take.
  const int64_t second = thumbnails[1].frame;
  EXPECT_EQ(neontetra("takes --trim " + std::to_string(second) + ":149 " + take).exit_code, 0);
  thumbnails = Take::open(take, Take::Access::read).thumbnails();
  EXPECT_EQ(thumbnails.front().frame, 0);
  json = Json::parse(neontetra("takes --json " + take).out)[0];
  EXPECT_EQ(json["video"]["first_frame"], -second);
  EXPECT_EQ(neontetra("takes --delete " + take).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(dir / ".deleted-takes/a.take"));
  EXPECT_TRUE(std::filesystem::exists(dir / ".deleted-takes/a.take.mkv"));
  EXPECT_FALSE(std::filesystem::exists(take + ".mkv"));
}

TEST(TakeRecording, MistakesAreOneLine) {
  const TempDir dir;
  EXPECT_EQ(neontetra(kCrossing + "--keep-video").exit_code, 2);
  write_text(dir / "a.take", "mine");
  const Outcome exists = neontetra(kCrossing + "--keep-video --take " + (dir / "a.take"));
  EXPECT_EQ(exists.exit_code, 1);
  EXPECT_NE(exists.err.find("never overwritten"), std::string::npos) << exists.err;
  EXPECT_FALSE(std::filesystem::exists(dir / "a.take.mkv"));
}

// Twice r in a window: the first recording begins before its key, the second where the first has ended.
TEST(TakeRecording, LiveRecordsTheSecondsBeforeTheKey) {
  if (std::system("command -v xvfb-run >/dev/null 2>&1 && command -v xdotool >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "no xvfb-run or xdotool";
  const TempDir dir;
  std::ofstream(dir / "script.sh") << "timeout 60 " NEONTETRA_BINARY
                                      " live -c sim:scene=calm,seed=1,frames=600,size=480x272 --character "
                                   << NEONTETRA_ASSETS "/characters/carp.png --pre-record 2 --keep-video --record-to "
                                   << (dir / "rec") << " --take " << (dir / "all.take") << " 2>" << (dir / "err")
                                   << " &\n"
                                      "program=$!\n"
                                      "window=$(timeout 20 xdotool search --sync --onlyvisible --name '^neontetra$')\n"
                                      "xdotool windowfocus $window\n"
                                      "sleep 4\nxdotool key r\nsleep 2\nxdotool key r\n"
                                      "sleep 0.5\nxdotool key r\nsleep 1\nxdotool key q\nwait $program\n";
  const std::string command = "xvfb-run -a -s '-screen 0 1600x900x24' sh " + (dir / "script.sh") + " >/dev/null 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0) << read_text(dir / "err");
  const auto info = [&](const char* name) { return Json::parse(neontetra("takes --json " + (dir / name)).out)[0]; };
  const Json first = info("rec-1.take"), second = info("rec-2.take"), all = info("all.take");
  // The video starts with the key, behind two seconds and more where frames were dropped.
  EXPECT_GE(first["video"]["first_frame"], 60);
  EXPECT_GT(second["video"]["first_frame"], 0);
  EXPECT_LT(second["video"]["first_frame"], 60);
  EXPECT_EQ(all["video"]["first_frame"], 0);
  EXPECT_EQ(first["character"], NEONTETRA_ASSETS "/characters/carp.png");
  EXPECT_GT(first["seconds"], 3);
  EXPECT_GT(all["seconds"].get<double>(), first["seconds"].get<double>() + second["seconds"].get<double>());
  // The take holds the frames of the table that was recorded with it, and those before them.
  const CsvTable csv(dir / "rec-1.csv");
  EXPECT_GT(first["frames"].get<std::size_t>(), csv.rows() + 50);
  for (const char* name : {"rec-1.take", "rec-2.take", "all.take"}) {
    cv::VideoCapture video((dir / name) + std::string(".mkv"));
    cv::Mat picture;
    int64_t pictures = 0;
    while (video.read(picture)) ++pictures;
    const Json json = info(name);
    const std::size_t frames = Take::open(dir / name, Take::Access::read).frames(0).size();
    EXPECT_EQ(pictures + json["video"]["first_frame"].get<int64_t>(), static_cast<int64_t>(frames)) << name;
  }
  EXPECT_NE(read_text(dir / "err").find("recording " + (dir / "rec-1.take") + " (with the last "), std::string::npos)
      << read_text(dir / "err");
}

}  // namespace
}  // namespace nt
