// SPDX-License-Identifier: Apache-2.0
#include "app/options.h"

#include <gtest/gtest.h>

#include "app/nearest_name.h"
#include "app/ui/colours.h"

namespace nt {
namespace {

using Kind = BackgroundOption::Kind;

TEST(Options, BackgroundModels) {
  EXPECT_EQ(parse_background("auto").kind, Kind::automatic);
  EXPECT_EQ(parse_background("vibe").kind, Kind::vibe);
  EXPECT_EQ(parse_background("backlit").kind, Kind::backlit);
  EXPECT_EQ(parse_background("vibe-colour").kind, Kind::vibe_colour);
  EXPECT_EQ(parse_background("still").picture, "");
  EXPECT_EQ(parse_background("still:empty.png").kind, Kind::still);
  EXPECT_EQ(parse_background("still:empty.png").picture, "empty.png");
  for (const char* wrong : {"vibes", "still:", "", "backlit:x.png"})
    EXPECT_THROW(parse_background(wrong), UserError) << wrong;
}

TEST(Options, SelectionIsAutomaticOrAPoint) {
  EXPECT_TRUE(parse_select("auto").automatic);
  const SelectOption at = parse_select("120.5,77");
  EXPECT_FALSE(at.automatic);
  EXPECT_FLOAT_EQ(at.at.x, 120.5f);
  EXPECT_FLOAT_EQ(at.at.y, 77.0f);
  for (const char* wrong : {"12", "12,", "a,b", "-1,4", "1,2,3"}) EXPECT_THROW(parse_select(wrong), UserError) << wrong;
}

TEST(Options, ARoiIsFourShares) {
  const RoiOption roi = parse_roi("0.25,0,0.5,1");
  EXPECT_DOUBLE_EQ(roi.x, 0.25);
  EXPECT_DOUBLE_EQ(roi.width, 0.5);
  EXPECT_DOUBLE_EQ(roi.height, 1);
  EXPECT_NO_THROW(parse_roi("0.1,0.7,0.9,0.3")) << "0.1 + 0.9 may be a little over 1";
  for (const char* wrong : {"", "0,0,1", "0,0,1,1,1", "0,0,0,1", "0.5,0,0.6,1", "-0.1,0,1,1", "a,0,1,1", "0,0,1,2"})
    EXPECT_THROW(parse_roi(wrong), UserError) << wrong;
}

TEST(Options, ATankIsCornersOrAPicture) {
  AreaOptions area;
  parse_tank({"1,2", "30.5,4", "5,60"}, area);
  ASSERT_EQ(area.polygon.size(), 3u);
  EXPECT_FLOAT_EQ(area.polygon[1].x, 30.5f);
  EXPECT_FALSE(area.everywhere());
  parse_tank({"tank.png"}, area);
  EXPECT_EQ(area.picture, "tank.png");
  EXPECT_TRUE(area.polygon.empty());
  for (const auto& wrong : std::vector<std::vector<std::string>>{
           {"1,2"}, {"1,2", "3,4"}, {"1,2", "3,4", "5"}, {"1,2", "3,4", "a,b"}, {"1,2", "3,4", "-5,6"}})
    EXPECT_THROW(parse_tank(wrong, area), UserError) << wrong.front();
}

TEST(Options, SizesAndColours) {
  EXPECT_EQ(parse_size("size", "640x360").height, 360);
  for (const char* wrong : {"640", "x360", "640x", "640x-1", "99999x10"})
    EXPECT_THROW(parse_size("size", wrong), UserError) << wrong;
  EXPECT_FLOAT_EQ(parse_colour("#ff8000").g, 128 / 255.0f);
  for (const char* wrong : {"red", "#12345", "#12345g", "1234567"})
    EXPECT_THROW(parse_colour(wrong), UserError) << wrong;
}

TEST(NearestName, CountsSwapsAsOne) {
  EXPECT_EQ(edit_distance("seed", "seed"), 0);
  EXPECT_EQ(edit_distance("sede", "seed"), 1);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(nearest_name("captur", {"live", "capture", "animate"}), "capture");
  EXPECT_EQ(nearest_name("x", {}), "");
}

}  // namespace
}  // namespace nt
