// SPDX-License-Identifier: Apache-2.0
// The real binary, given what users give by mistake: one clear line on stderr and the documented exit code.
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "tests/app/csv_table.h"
#include "tests/app/run_binary.h"

namespace nt {
namespace {

const std::string kCarp = NEONTETRA_ASSETS "/characters/carp.png";

void expect_one_line(const Outcome& outcome, int exit_code, const std::string& part) {
  EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
  EXPECT_EQ(outcome.error_lines(), 1) << outcome.err;
  EXPECT_TRUE(outcome.err.starts_with("neontetra: ")) << outcome.err;
  EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
}

void write_video(const std::string& path, int width, int height, int frames) {
  cv::VideoWriter video(path, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10, {width, height});
  ASSERT_TRUE(video.isOpened());
  for (int i = 0; i < frames; ++i) {
    cv::Mat frame(height, width, CV_8UC3, cv::Scalar(230, 230, 230));
    cv::ellipse(frame, {width / 2, height / 2 + i}, {width / 5, width / 30}, 0, 0, 360, {20, 20, 20}, cv::FILLED);
    video.write(frame);
  }
}

TEST(Cli, HelpAndVersionGoToStandardOutput) {
  const Outcome help = neontetra("--help");
  EXPECT_EQ(help.exit_code, 0);
  for (const std::string command : {"live", "capture", "animate", "character", "bench", "doctor"}) {
    EXPECT_NE(help.out.find("\n  " + command), std::string::npos) << command;
    const Outcome own = neontetra(command + " --help");
    EXPECT_EQ(own.exit_code, 0);
    EXPECT_NE(own.out.find("Example: neontetra " + command), std::string::npos) << own.out;
  }
  EXPECT_EQ(neontetra("--version").out, "neontetra " NEONTETRA_VERSION "\n");
}

TEST(Cli, MistypedWordsNameTheNearest) {
  expect_one_line(neontetra(""), 2, "say what to do");
  expect_one_line(neontetra("captrue -c sim"), 2, "did you mean 'capture'");
  expect_one_line(neontetra("capture -c sim --csvv x"), 2, "did you mean --csv?");
  expect_one_line(neontetra("--verson"), 2, "did you mean --version?");
  expect_one_line(neontetra("capture -c sim:sede=4"), 2, "did you mean 'seed'");
  expect_one_line(neontetra("capture -c sim:scene=clam"), 2, "did you mean 'calm'");
  expect_one_line(neontetra("capture -c sim --background vibes"), 2, "did you mean 'vibe'");
  expect_one_line(neontetra("capture -c sim extra"), 2, "'extra' is not expected");
}

TEST(Cli, ValuesThatCannotBe) {
  expect_one_line(neontetra("capture"), 2, "--camera");
  expect_one_line(neontetra("capture -c sim --frames lots"), 2, "whole number");
  expect_one_line(neontetra("capture -c sim --select 3"), 2, "X,Y");
  expect_one_line(neontetra("capture -c sim --work-size big"), 2, "960x544");
  expect_one_line(neontetra("animate -c sim --character " + kCarp + " --out x.mp4 --backdrop red"), 2, "#1B4B5A");
  expect_one_line(neontetra("animate -c sim --character " + kCarp + " --out x.mp4 --inbetweens 99"), 2, "--inbetweens");
  expect_one_line(neontetra("capture -c " + kCarp + " --truth /dev/null --background vibe"), 2, "sim");
}

TEST(Cli, CharactersBackdropsAndSchoolsThatCannotBe) {
  const std::string animate = "animate -c sim:frames=2 --out x.mp4 --character " + kCarp;
  expect_one_line(neontetra(animate + " --backdrop /no/sea.png"), 2, "there is no picture '/no/sea.png'");
  expect_one_line(neontetra(animate + " --school 0"), 2, "--school");
  expect_one_line(neontetra(animate + " --school many"), 2, "--school");
  expect_one_line(neontetra(animate + " --mls stiff"), 2, "--mls");
  expect_one_line(neontetra(animate + " --max-fish 99"), 2, "--max-fish");
  expect_one_line(neontetra(animate + " --character " + kCarp), 2, "--school 2");
  expect_one_line(neontetra("animate -c sim:frames=2 --out x.mp4 --character /no/carp.png"), 1, "/no/carp.png");
  expect_one_line(neontetra("live -c sim --character " + kCarp + " --info-text '%speed'"), 2, "%speed");
  expect_one_line(neontetra("live -c sim --layout behind --backdrop camera --character " + kCarp), 2,
                  "--layout behind");
  expect_one_line(neontetra("live -c sim --record-to none/fish --display null --frames 5 --character " + kCarp), 1,
                  "there is no folder none");
  expect_one_line(neontetra("live -c sim --layout alon --character " + kCarp), 2, "--layout");
}

TEST(Cli, PlacesAndSizesOutsideThePicture) {
  expect_one_line(neontetra("capture -c sim:size=320x240,frames=2 --background vibe --select 320,10"), 2,
                  "X is at most 319 and Y 239");
  expect_one_line(neontetra("capture -c sim:size=320x240,frames=2 --background vibe --select 10,240"), 2, "--select");
  EXPECT_EQ(neontetra("capture -c sim:size=320x240,frames=2 --background vibe --select 319,239").exit_code, 0);
  expect_one_line(neontetra("capture -c sim:size=33x33"), 2, "use 64x48 to 7680x4320");
  expect_one_line(neontetra("bench --work-size 9000x9000"), 2, "use 64x48 to 7680x4320");
}

TEST(Cli, BenchTakesEveryBackgroundOfItsHelp) {
  const TempDir dir;
  cv::imwrite(dir / "empty.png", cv::Mat(240, 320, CV_8UC1, cv::Scalar(90)));
  for (const std::string& model : {std::string("vibe"), std::string("still"), "still:" + dir / "empty.png",
                                   std::string("backlit"), std::string("auto")}) {
    const Outcome outcome = neontetra("bench --frames 3 --work-size 320x240 --background " + model);
    EXPECT_EQ(outcome.exit_code, 0) << model << ": " << outcome.err;
  }
}

TEST(Cli, VideosThatAreNone) {
  const TempDir dir;
  expect_one_line(neontetra("capture -c " + dir / "none.avi"), 3, "none.avi");
  EXPECT_NE(neontetra("capture -c file:" + dir / "none.avi").exit_code, 0);
  EXPECT_EQ(neontetra("capture -c file:" + dir / "none.avi").error_lines(), 1);
  std::ofstream(dir / "empty.mp4").close();
  std::ofstream(dir / "text.mp4") << "this is no video\n";
  for (const std::string name : {"empty.mp4", "text.mp4"}) {
    const Outcome outcome = neontetra("capture -c " + dir / name);
    EXPECT_NE(outcome.exit_code, 0);
    EXPECT_EQ(outcome.error_lines(), 1) << outcome.err;
  }
}

TEST(Cli, ATruncatedVideoGivesWhatItHasOrOneLine) {
  const TempDir dir;
  write_video(dir / "whole.avi", 320, 240, 30);
  const std::string whole = read_text(dir / "whole.avi");
  std::ofstream(dir / "head.avi", std::ios::binary) << whole.substr(0, 300);
  const Outcome head = neontetra("capture --background vibe -c " + dir / "head.avi");
  EXPECT_NE(head.exit_code, 0);
  EXPECT_EQ(head.error_lines(), 1) << head.err;
  std::ofstream(dir / "half.avi", std::ios::binary) << whole.substr(0, whole.size() / 2);
  const Outcome half = neontetra("capture --background vibe -c " + dir / "half.avi" + " --csv " + dir / "half.csv");
  EXPECT_EQ(half.exit_code, 0) << half.err;
  const std::size_t rows = CsvTable(dir / "half.csv").rows();
  EXPECT_GT(rows, 5u);
  EXPECT_LT(rows, 25u);
}

TEST(Cli, TinyAndHugeFrames) {
  const TempDir dir;
  cv::imwrite(dir / "one.png", cv::Mat(1, 1, CV_8UC3, cv::Scalar(9, 9, 9)));
  const Outcome tiny = neontetra("capture -c " + dir / "one.png");
  EXPECT_NE(tiny.exit_code, 0);
  EXPECT_EQ(tiny.error_lines(), 1) << tiny.err;
  write_video(dir / "8k.avi", 7680, 4320, 3);
  const Outcome huge = neontetra("capture --background backlit -c " + dir / "8k.avi" + " --csv " + dir / "8k.csv");
  EXPECT_EQ(huge.exit_code, 0) << huge.err;
  EXPECT_EQ(CsvTable(dir / "8k.csv").rows(), 3u);
}

TEST(Cli, PicturesWithoutAFish) {
  const TempDir dir;
  cv::imwrite(dir / "plain.png", cv::Mat(200, 300, CV_8UC3, cv::Scalar(120, 120, 120)));
  cv::imwrite(dir / "clear.png", cv::Mat(200, 300, CV_8UC4, cv::Scalar(0, 0, 0, 0)));
  for (const std::string name : {"plain.png", "clear.png"}) {
    expect_one_line(neontetra("character " + dir / name + " --out " + dir / "x.ntchar"), 1, name);
    EXPECT_FALSE(std::filesystem::exists(dir / "x.ntchar"));
  }
  expect_one_line(neontetra("character " + dir / "none.png" + " --out " + dir / "x.ntchar"), 1, "none.png");
}

TEST(Cli, AFullDiskKeepsCompleteRows) {
  const TempDir dir;
  const Outcome device = neontetra("capture --background vibe -c sim:frames=80 --csv /dev/full");
  expect_one_line(device, 1, "/dev/full: No space left on device");
  EXPECT_EQ(device.err.find("rows"), std::string::npos) << device.err;  // a device keeps none
  expect_one_line(neontetra("capture --background vibe -c sim:frames=3 --json /dev/full"), 1, "/dev/full");
  expect_one_line(neontetra("bench --frames 3 >/dev/full"), 1, "standard output");
  expect_one_line(neontetra("capture --background vibe -c sim:frames=250 --csv " + dir / "cut.csv", 20), 1, "cut.csv");
  const CsvTable cut(dir / "cut.csv");
  ASSERT_GT(cut.rows(), 5u);
  for (std::size_t row = 0; row < cut.rows(); ++row) EXPECT_EQ(cut.cells(row), cut.columns());
  EXPECT_EQ(read_text(dir / "cut.csv").back(), '\n');
}

TEST(Cli, AnErrorElsewhereKeepsTheRowsUpToIt) {
  const TempDir dir;
  for (int i = 0; i < 7; ++i) {
    const int width = i == 6 ? 200 : 320;
    cv::imwrite(dir / ("frame_" + std::to_string(i) + ".png"), cv::Mat(240, width, CV_8UC1, cv::Scalar(200)));
  }
  const std::string pattern = dir / "frame_%d.png";
  expect_one_line(neontetra("capture --background vibe -c 'file:" + pattern + "' --csv " + dir / "cut.csv"), 1,
                  "200x240");
  EXPECT_EQ(CsvTable(dir / "cut.csv").rows(), 6u);
}

TEST(Cli, AFullDiskWhileWritingTheVideo) {
  const TempDir dir;
  expect_one_line(neontetra("capture --background vibe -c sim:frames=60 --overlay " + dir / "cut.mp4", 200), 1,
                  "cut.mp4");
  expect_one_line(neontetra("capture --background vibe -c sim:frames=3 --overlay " + dir / "no/such/folder.mp4"), 1,
                  "folder.mp4");
}

TEST(Cli, AReaderThatStopsEarlyIsNoError) {
  const Outcome outcome = neontetra("bench --frames 3 | true");
  EXPECT_EQ(outcome.err, "");
}

TEST(Cli, WhereNobodyReadsItsRowsARunEnds) {
  const Outcome outcome = neontetra(
      "capture -c sim:scene=ghost,size=160x96 --work-size 160x96 --background vibe --frames 5000 --csv - | head -1");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("frames, "), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("5000 frames, "), std::string::npos) << outcome.err;
}

// Two seconds of it; what a program that is killed outright leaves is at most one second short.
TEST(Cli, AClosedTerminalEndsARunAndAKillLeavesItsRows) {
  const TempDir dir;
  for (const char* signal : {"HUP", "KILL"}) {
    const std::string csv = dir / (std::string(signal) + ".csv");
    const Outcome outcome = neontetra(
        "capture -c sim:scene=ghost,size=160x96 --work-size 160x96 --background vibe --real-time --csv " + csv +
        " & p=$!; until [ $(wc -l <" + csv + ") -gt 30 ]; do sleep 0.1; done; kill -" + signal + " $p; wait $p");
    EXPECT_EQ(outcome.exit_code == 0, std::string(signal) == "HUP") << signal;
  }
}

}  // namespace
}  // namespace nt
