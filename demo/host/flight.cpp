// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "host/flight.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <glm/gtc/constants.hpp>
#include <string_view>

namespace sward::host {

namespace {

std::vector<std::string_view> split_cells(std::string_view line) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  std::vector<std::string_view> cells;
  while (true) {
    const size_t comma = line.find(',');
    std::string_view cell = line.substr(0, comma);
    while (cell.starts_with(' ')) cell.remove_prefix(1);
    while (cell.ends_with(' ')) cell.remove_suffix(1);
    cells.push_back(cell);
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

bool parse_number(std::string_view cell, double& value) {
  if (cell.starts_with('+')) cell.remove_prefix(1);
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc() && end == cell.data() + cell.size() && !cell.empty();
}

std::vector<std::string> matrix_columns() {
  std::vector<std::string> names{"frame", "ex", "ey", "ez"};
  for (const char* matrix : {"v", "p"})
    for (int i = 0; i < 16; ++i) names.push_back(matrix + std::to_string(i));
  names.insert(names.end(), {"vpw", "vph"});
  return names;
}

std::vector<std::string> pose_columns() {
  return {"time", "x", "y", "z", "yaw", "pitch"};
}

bool header_is(const std::vector<std::string_view>& cells, const std::vector<std::string>& names) {
  return std::equal(cells.begin(), cells.end(), names.begin(), names.end());
}

Expected<FlightFrame> frame_from_matrices(std::span<const double> row, size_t index, const FlightOptions& options) {
  glm::dmat4 view(1), projection(1);
  for (int i = 0; i < 16; ++i) {
    view[i / 4][i % 4] = row[size_t(4 + i)];
    projection[i / 4][i % 4] = row[size_t(20 + i)];
  }
  const double width = row[36], height = row[37];
  if (!(width >= 1 && width <= 65536 && height >= 1 && height <= 65536) || width != std::floor(width) ||
      height != std::floor(height))
    return fail("the viewport vpw x vph must be whole numbers of pixels from 1 to 65536");
  auto made = View::from_matrices({row[1], row[2], row[3]}, view, projection, {int(width), int(height)});
  if (!made) return tl::unexpected(made.error());
  return FlightFrame{double(index) / options.fps, *made};
}

Expected<FlightFrame> frame_from_pose(std::span<const double> row, const FlightOptions& options) {
  const View view = View::look({row[1], row[2], row[3]}, glm::radians(row[4]), glm::radians(row[5]), options.fov_y,
                               options.viewport, options.near_plane, options.far_plane);
  if (auto valid = view.validate(); !valid) return tl::unexpected(valid.error());
  if (!std::isfinite(row[0])) return fail("time must be a finite number of seconds");
  return FlightFrame{row[0], view};
}

}  // namespace

Expected<std::vector<FlightFrame>> load_flight(const std::string& path, const FlightOptions& options) {
  std::ifstream file(path);
  if (!file) return fail(path + ": cannot open the flight; it must be a CSV file or the built-in \"paper\"");
  std::string line;
  if (!std::getline(file, line)) return fail(path + ":1: the flight is empty; a header line is expected");
  const bool matrices = header_is(split_cells(line), matrix_columns());
  if (!matrices && !header_is(split_cells(line), pose_columns()))
    return fail(path + ":1: the header must be time,x,y,z,yaw,pitch or frame,ex,ey,ez,v0..v15,p0..p15,vpw,vph");
  const size_t columns = (matrices ? matrix_columns() : pose_columns()).size();

  std::vector<FlightFrame> frames;
  std::vector<double> row(columns);
  for (int number = 2; std::getline(file, line); ++number) {
    if (line.empty() || line == "\r") continue;
    const std::string where = path + ":" + std::to_string(number) + ": ";
    const std::vector<std::string_view> cells = split_cells(line);
    if (cells.size() != columns)
      return fail(where + std::to_string(cells.size()) + " cells, expected " + std::to_string(columns));
    for (size_t i = 0; i < columns; ++i)
      if (!parse_number(cells[i], row[i])) return fail(where + "\"" + std::string(cells[i]) + "\" is not a number");
    auto frame = matrices ? frame_from_matrices(row, frames.size(), options) : frame_from_pose(row, options);
    if (!frame) return fail(where + frame.error().message);
    if (!frames.empty() && frame->time_s < frames.back().time_s) return fail(where + "time runs backwards");
    frames.push_back(*frame);
  }
  if (frames.empty()) return fail(path + ": the flight has no frame after its header");
  return frames;
}

}  // namespace sward::host
