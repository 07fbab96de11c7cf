// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "sward/output/plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sward/output/files.h"

namespace sward::tool {

namespace {

constexpr double k_width = 900, k_height = 420;
constexpr double k_left = 76, k_right = 20, k_top = 44, k_bottom = 52;
constexpr const char* k_colors[] = {"#1b6ca8", "#c44536", "#3a7d44", "#8e5ea2", "#c98a1b", "#4a4a4a"};

// The round step (1, 2 or 5 times a power of ten) that cuts a length into about six.
double round_step(double length) {
  const double rough = length / 6, power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough) return factor * power;
  return 10 * power;
}

struct Axis {
  double low = 0, high = 1, from_px = 0, to_px = 1;
  double place(double value) const { return from_px + (value - low) / (high - low) * (to_px - from_px); }
};

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string text_at(double x, double y, const char* anchor, const std::string& text, const std::string& more = "") {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\"" + more + ">" + text +
         "</text>\n";
}

std::string grid_line(double x1, double y1, double x2, double y2) {
  return "<line x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" + number(x2) + "\" y2=\"" + number(y2) +
         "\" stroke=\"#dddddd\"/>\n";
}

std::string grid(const Axis& x, const Axis& y) {
  std::string svg;
  const double x_step = round_step(x.high - x.low), y_step = round_step(y.high - y.low);
  for (double at = std::ceil(x.low / x_step) * x_step; at <= x.high + x_step * 1e-6; at += x_step)
    svg += grid_line(x.place(at), y.from_px, x.place(at), y.to_px) +
           text_at(x.place(at), y.from_px + 18, "middle", number(at));
  for (double at = 0; at <= y.high + y_step * 1e-6; at += y_step)
    svg += grid_line(x.from_px, y.place(at), x.to_px, y.place(at)) +
           text_at(x.from_px - 8, y.place(at) + 4, "end", number(at));
  return svg;
}

std::string poly_line(const Axis& x, const Axis& y, std::span<const double> places, const PlotLine& line,
                      const char* color) {
  std::string svg = "<polyline fill=\"none\" stroke-width=\"1.4\" stroke=\"" + std::string(color) + "\" points=\"";
  char point[48];
  for (size_t i = 0; i < line.values.size(); ++i) {
    std::snprintf(point, sizeof point, "%.1f,%.1f ", x.place(places[i]), y.place(line.values[i]));
    svg += point;
  }
  return svg + "\"/>\n";
}

}  // namespace

std::string line_plot(const std::string& title, const std::string& x_name, std::span<const double> x,
                      const std::string& y_name, std::span<const PlotLine> lines) {
  double highest = 0;
  for (const PlotLine& line : lines)
    for (const double value : line.values) highest = std::max(highest, value);
  Axis across{x.front(), x.back(), k_left, k_width - k_right};
  if (across.high <= across.low) across.high = across.low + 1;
  const Axis up{0, highest > 0 ? highest * 1.05 : 1, k_height - k_bottom, k_top};

  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(k_width) + " " +
                    number(k_height) + "\" font-family=\"sans-serif\" font-size=\"12\">\n" +
                    "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  svg += text_at(k_left, 20, "start", title, " font-size=\"15\"");
  svg += grid(across, up);
  svg += text_at((k_left + k_width - k_right) / 2, k_height - 12, "middle", x_name);
  svg += text_at(18, (k_top + k_height - k_bottom) / 2, "middle", y_name,
                 " transform=\"rotate(-90 18 " + number((k_top + k_height - k_bottom) / 2) + ")\"");
  double legend_x = k_left;
  for (size_t i = 0; i < lines.size(); ++i) {
    const char* color = k_colors[i % std::size(k_colors)];
    svg += poly_line(across, up, x, lines[i], color);
    svg += text_at(legend_x, 37, "start", lines[i].name, std::string(" fill=\"") + color + "\"");
    legend_x += 20 + 7.0 * double(lines[i].name.size());
  }
  return svg + "</svg>\n";
}

Expected<void> write_plots(const std::string& folder, std::span<const FrameFigures> frames) {
  struct Plot {
    const char *file, *title, *unit;
    std::vector<std::string_view> names;
  };
  const Plot plots[] = {
      {"times.svg",
       "Time a frame",
       "milliseconds",
       {"frame_ms", "cpu_roam_ms", "cpu_seeding_ms", "gpu_terrain_ms", "gpu_classify_ms", "gpu_grow_ms"}},
      {"plants.svg", "Plants", "count", {"plants", "clusters_submitted", "clusters_fertile"}},
      {"triangles.svg", "Triangles", "count", {"triangles_drawn", "triangles_visible", "fixed_triangles"}},
      {"bound.svg", "Bound of the terrain's error", "pixels", {"bound_px"}},
  };
  std::vector<double> times;
  for (const FrameFigures& frame : frames) times.push_back(frame.time_s);
  for (const Plot& plot : plots) {
    std::vector<PlotLine> lines;
    for (const FigureColumn& column : figure_columns()) {
      if (std::find(plot.names.begin(), plot.names.end(), column.name) == plot.names.end()) continue;
      PlotLine line{std::string(column.name), {}};
      for (const FrameFigures& frame : frames)
        if (const Figure& figure = frame.*column.member) line.values.push_back(*figure);
      if (line.values.size() == times.size()) lines.push_back(std::move(line));
    }
    const std::string svg = line_plot(plot.title, "seconds", times, plot.unit, lines);
    if (auto written = write_file(folder + "/" + plot.file, svg); !written) return written;
  }
  return {};
}

}  // namespace sward::tool
