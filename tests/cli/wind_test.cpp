// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// A scene's wind reaches its plants in pictures.

#include "cli_support.h"

namespace {

class CliWind : public cli::CliTest {
 protected:
  // The picture of the small scene with more keys, at a time.
  std::string picture(const std::string& keys, const std::string& time) {
    cli::write_file(inputs() / "windy.toml", cli::read_file(scene()) + keys);
    const cli::Result result = run("render " + (inputs() / "windy.toml").string() + " --size 96x64 --time " + time +
                                   " --camera 0,0,+1.2,90,-12 -o a.ppm");
    EXPECT_EQ(result.status, 0) << result.err;
    return cli::read_file(folder() / "a.ppm");
  }
};

TEST_F(CliWind, MovesPlantsInTimeAndLeavesStillScenesAlone) {
  if (run("info").status != 0) GTEST_SKIP() << "no GL context";
  const std::string still = picture("", "1"), windy = picture("[wind]\nspeed_m_s = 15\n", "1");
  ASSERT_FALSE(still.empty());
  EXPECT_NE(still, windy);
  EXPECT_NE(windy, picture("[wind]\nspeed_m_s = 15\n", "1.5"));
  EXPECT_EQ(windy, picture("[wind]\nspeed_m_s = 15\n", "1"));  // the same moment, the same picture
  EXPECT_EQ(still, picture("", "1.5"));
}

}  // namespace
