// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "sward/output/figures.h"

namespace sward::tool {

struct PlotLine {
  std::string name;
  std::vector<double> values;  ///< One for each place on the x axis.
};

/// A line plot as an SVG document: axes from 0 (x from its first value) with round steps, grid, legend.
std::string line_plot(const std::string& title, const std::string& x_name, std::span<const double> x,
                      const std::string& y_name, std::span<const PlotLine> lines);

/// The figures of a flight as SVG files in `folder`: times.svg, plants.svg, triangles.svg, bound.svg. Figures that were
/// not measured are left out.
Expected<void> write_plots(const std::string& folder, std::span<const FrameFigures> frames);

}  // namespace sward::tool
