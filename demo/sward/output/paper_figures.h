// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "sward/output/figures.h"

namespace sward::tool {

/// The same flight, flown as section 4 of the 2015 paper measures it.
struct PaperRuns {
  struct Clusters {
    int size = 1;  ///< Seeds a cluster.
    std::vector<FrameFigures> frames;
  };
  std::vector<FrameFigures> with, without;  ///< With and without vegetation.
  std::vector<Clusters> clusters;           ///< Nothing rasterised; empty where the driver cannot time the GPU.
};

/// figure7 (frame time with and without vegetation), figure8 (clusters submitted, bare and fertile; triangles) and
/// figure9 (classification and growth without rasterisation, by cluster size), each as .csv and .svg in `folder`, means
/// over intervals of one second. Without cluster runs figure9 is left out.
Expected<void> write_paper_figures(const std::string& folder, const PaperRuns& runs);

}  // namespace sward::tool
