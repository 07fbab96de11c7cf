// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// Images as detail textures of the ground: what is wrong with them is said with the scene's file and line.

#include "cli_support.h"

namespace {

#ifdef SWARD_IMAGE_IO

class CliGround : public cli::CliTest {
 protected:
  std::string picture(const std::string& name, int width, int height, char grey) const {
    std::string bytes = "P6\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n";
    for (int i = 0; i < width * height; ++i) bytes += std::string(3, grey == 0 ? char(0) : char(grey + i % 50));
    cli::write_file(inputs() / name, bytes);
    return name;
  }
  cli::Result list_with(const std::string& detail) const {
    const std::string text = cli::read_file(scene());
    cli::write_file(inputs() / "ground.toml", text.substr(0, text.find("[[layer]]")) +
                                                  "[[terrain.material]]\ndetail = \"" + detail + "\"\n" +
                                                  text.substr(text.find("[[layer]]")));
    return run("plants " + (inputs() / "ground.toml").string() + " --region 0,0,2,2 -o plants.csv");
  }
};

TEST_F(CliGround, SquareImagesOfOddSizesAreTaken) {
  const cli::Result result = list_with(picture("odd.ppm", 37, 37, 100));
  EXPECT_EQ(result.status, 0) << result.err;
}

TEST_F(CliGround, WrongImagesAreNamedWithTheScenesLine) {
  const auto expect = [&](const std::string& detail, const std::string& words) {
    const cli::Result result = list_with(detail);
    expect_error(result, 1);
    EXPECT_NE(result.err.find("ground.toml:7: "), std::string::npos) << result.err;
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
  };
  expect(picture("wide.ppm", 64, 32, 100), "wide.ppm is 64 x 32 texels; a detail texture must be square");
  expect(picture("tiny.ppm", 8, 8, 100), "16 to 8192");
  expect(picture("black.ppm", 32, 32, 0), "black");
  expect("missing.png", "missing.png");
  expect_error(list_with("missing"), 1);
}

#endif

}  // namespace
