// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "scene/generated_grid.h"

namespace sward::generated {

/// Where the water of each sample goes: a forest rooted in the samples of the grid's edge.
struct Flow {
  std::vector<int32_t> order;     ///< All samples, each after its receiver.
  std::vector<int32_t> receiver;  ///< Of each sample; the edge's receive themselves.
  std::vector<float> distance;    ///< Metres to the receiver; 0 on the edge.
  std::vector<float> area;        ///< Square metres that drain through each sample, its own included.
};

/// Fills every depression of `heights` up to its spill point and drains the result (priority flood: Barnes, Lehman,
/// Mulla, "Priority-flood", 2014). Neighbours are compared as if each sample stood somewhere at random near its place,
/// drawn from `seed`, so that valleys do not keep to the grid's eight directions. Heights must be above 0.
void route_flow(Grid& heights, uint32_t seed, Flow& flow);

/// The forces, sample by sample. Time is counted in units of the whole history.
struct Forces {
  Grid uplift;    ///< Metres a unit of time.
  Grid incision;  ///< K of dz/dt = -K sqrt(area) slope, 1 a unit of time.
  Grid creep;     ///< Diffusion of soil, square metres a unit of time.
  Grid steepest;  ///< Slope near which soil and scree cannot stay, rise over run.
};

struct History {
  int steps = 1;
  float dt = 0.01f;           ///< Units of time a step.
  int steps_per_routing = 1;  ///< Steps between two findings of the flow.
};

/// Lets the forces act: uplift, incision (implicit, so any step is stable: Braun and Willett, "A very efficient O(n),
/// implicit and parallel method to solve the stream power equation", 2013), rockfall, creep. The edge keeps its
/// heights.
void erode(Grid& heights, const Forces& forces, const History& history, uint32_t seed);

/// Drainage area shared among all lower neighbours by slope (Freeman 1991): smooth over hillslopes, for painting.
Grid spread_area(const Grid& heights, const Flow& flow);

}  // namespace sward::generated
