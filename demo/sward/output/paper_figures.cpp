// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "sward/output/paper_figures.h"

#include <cmath>
#include <functional>

#include "sward/output/files.h"
#include "sward/output/plot.h"

namespace sward::tool {

namespace {

using Measure = std::function<Figure(const FrameFigures&)>;

struct Table {
  std::vector<double> seconds;  // where each interval begins
  std::vector<PlotLine> lines;
};

// Means over intervals of a second; the intervals are those of the first run that is added.
void add_line(Table& table, const std::string& name, const std::vector<FrameFigures>& frames, const Measure& measure) {
  PlotLine line{name, {}};
  std::vector<double> seconds;
  double sum = 0;
  int count = 0;
  const auto close = [&] {
    if (count > 0) line.values.push_back(sum / count);
    sum = 0;
    count = 0;
  };
  for (const FrameFigures& frame : frames) {
    const double second = std::floor(frame.time_s);
    if (seconds.empty() || second > seconds.back()) {
      close();
      seconds.push_back(second);
    }
    const Figure value = measure(frame);
    if (!value) return;
    sum += *value;
    ++count;
  }
  close();
  if (table.seconds.empty()) table.seconds = seconds;
  SWARD_ASSERT(table.seconds == seconds, "the runs of a figure are over the same flight");
  table.lines.push_back(std::move(line));
}

std::string csv_of(const Table& table) {
  std::string csv = "second";
  for (const PlotLine& line : table.lines) csv += "," + line.name;
  csv += "\n";
  for (size_t i = 0; i < table.seconds.size(); ++i) {
    csv += figure_text(table.seconds[i]);
    for (const PlotLine& line : table.lines) csv += "," + figure_text(line.values[i]);
    csv += "\n";
  }
  return csv;
}

Expected<void> write_table(const std::string& path, const std::string& title, const std::string& unit,
                           const Table& table) {
  if (auto written = write_file(path + ".csv", csv_of(table)); !written) return written;
  return write_file(path + ".svg", line_plot(title, "seconds", table.seconds, unit, table.lines));
}

Measure member(Figure FrameFigures::*figure) {
  return [figure](const FrameFigures& frame) { return frame.*figure; };
}

Expected<void> write_figure7(const std::string& folder, const PaperRuns& runs) {
  Table table;
  add_line(table, "frame_ms", runs.with, member(&FrameFigures::frame_ms));
  add_line(table, "without_vegetation_ms", runs.without, member(&FrameFigures::frame_ms));
  return write_table(folder + "/figure7", "Time a frame, with and without vegetation", "milliseconds", table);
}

// Triangles are of the plants and their shadows, in hundreds, so that one axis serves.
Expected<void> write_figure8(const std::string& folder, const PaperRuns& runs) {
  Table table;
  add_line(table, "clusters_submitted", runs.with, member(&FrameFigures::clusters_submitted));
  add_line(table, "clusters_bare", runs.with,
           [](const FrameFigures& frame) -> Figure { return *frame.clusters_submitted - *frame.clusters_fertile; });
  add_line(table, "clusters_fertile", runs.with, member(&FrameFigures::clusters_fertile));
  add_line(table, "plant_triangles_in_hundreds", runs.with, [](const FrameFigures& frame) -> Figure {
    return (*frame.triangles_drawn - *frame.triangles_visible) / 100;
  });
  return write_table(folder + "/figure8", "Load: clusters and triangles", "count", table);
}

Expected<void> write_figure9(const std::string& folder, const PaperRuns& runs) {
  Table table;
  for (const PaperRuns::Clusters& run : runs.clusters) {
    add_line(table, "clusters_of_" + std::to_string(run.size) + "_ms", run.frames,
             [](const FrameFigures& frame) -> Figure {
               if (!frame.gpu_classify_ms || !frame.gpu_grow_ms) return {};
               return *frame.gpu_classify_ms + *frame.gpu_grow_ms;
             });
  }
  return write_table(folder + "/figure9", "Classification and growth without rasterisation", "milliseconds", table);
}

}  // namespace

Expected<void> write_paper_figures(const std::string& folder, const PaperRuns& runs) {
  if (auto written = write_figure7(folder, runs); !written) return written;
  if (auto written = write_figure8(folder, runs); !written) return written;
  return runs.clusters.empty() ? Expected<void>() : write_figure9(folder, runs);
}

}  // namespace sward::tool
