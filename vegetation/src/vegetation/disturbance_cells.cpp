// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Single cells of a tile: what they hold at a moment, and what a touch makes of them.

#include <algorithm>
#include <cmath>

#include "vegetation/disturbance_tiles.h"

namespace sward {

namespace {

/// Share that is left after a time; a touch in the future (of a damaged clock) has not decayed.
float share_after(uint32_t touched, uint32_t now, double half_life_ticks) {
  return now > touched ? float(std::exp2(-double(now - touched) / half_life_ticks)) : 1.0f;
}

uint8_t to_byte(float share) {
  return uint8_t(std::lround(std::clamp(share, 0.0f, 1.0f) * 255.0f));
}

glm::vec2 press_of(const PressPlane& plane, size_t cell) {
  return glm::vec2(plane.way[cell][0], plane.way[cell][1]) / 127.0f;
}

template <class Plane>
Plane& made(std::unique_ptr<Plane>& plane) {
  if (!plane) plane = std::make_unique<Plane>();
  return *plane;
}

/// What regrowth has left becomes what stands, and stays.
bool end_regrowth(DisturbanceTile& tile, size_t cell, uint32_t now) {
  if (!tile.regrow || tile.regrow->end[cell] == 0) return false;
  const float share = share_standing(tile, int(cell), now);
  const auto keep = [share](uint8_t& value) { value = uint8_t(std::lround(float(value) * share)); };
  if (tile.lasting) keep(tile.lasting->cut[cell]), keep(tile.lasting->burn[cell]);
  if (tile.paint) std::ranges::for_each(tile.paint->paint[cell], keep);
  tile.regrow->start[cell] = tile.regrow->end[cell] = 0;
  return true;
}

}  // namespace

float share_standing(const DisturbanceTile& tile, int cell, uint32_t now) {
  if (!tile.regrow || tile.regrow->end[size_t(cell)] == 0) return 1.0f;
  const uint32_t start = tile.regrow->start[size_t(cell)], end = tile.regrow->end[size_t(cell)];
  if (now >= end || end <= start) return 0.0f;
  return now <= start ? 1.0f : 1.0f - float(now - start) / float(end - start);
}

Disturbed read_cell(const DisturbanceTile& tile, int cell, const CellClock& clock) {
  const auto i = size_t(cell);
  Disturbed d;
  if (tile.press && (tile.press->way[i][0] != 0 || tile.press->way[i][1] != 0))
    d.press = press_of(*tile.press, i) * share_after(tile.press->time[i], clock.now, clock.press_ticks);
  if (tile.wet && tile.wet->wet[i] != 0)
    d.wet = float(tile.wet->wet[i]) / 255.0f * share_after(tile.wet->time[i], clock.now, clock.wet_ticks);
  if (!tile.lasting && !tile.paint) return d;
  const float standing = share_standing(tile, cell, clock.now) / 255.0f;
  if (tile.lasting) {
    d.cut = float(tile.lasting->cut[i]) * standing;
    d.burn = float(tile.lasting->burn[i]) * standing;
  }
  if (tile.paint)
    for (size_t c = 0; c < 4; ++c) d.paint[int(c)] = float(tile.paint->paint[i][c]) * standing;
  return d;
}

bool touch_press(DisturbanceTile& tile, int cell, glm::vec2 press, const CellClock& clock) {
  const auto i = size_t(cell);
  const float length = glm::length(press);
  if (length > 1.0f) press /= length;
  const glm::vec2 bytes = glm::round(press * 127.0f);
  if (bytes == glm::vec2(0)) return false;
  if (tile.press) {
    const glm::vec2 there = read_cell(tile, cell, clock).press * 127.0f;
    if (glm::dot(bytes, bytes) <= glm::dot(there, there)) return false;
  }
  PressPlane& plane = made(tile.press);
  plane.way[i] = {int8_t(bytes.x), int8_t(bytes.y)};
  plane.time[i] = clock.now;
  tile.pressed = clock.now;
  return true;
}

bool touch_wet(DisturbanceTile& tile, int cell, float wet, const CellClock& clock) {
  const uint8_t byte = to_byte(wet);
  if (byte == 0 || (tile.wet && float(byte) <= read_cell(tile, cell, clock).wet * 255.0f)) return false;
  WetPlane& plane = made(tile.wet);
  plane.wet[size_t(cell)] = byte;
  plane.time[size_t(cell)] = clock.now;
  tile.wetted = clock.now;
  return true;
}

bool touch_lasting(DisturbanceTile& tile, int cell, float cut, float burn, const CellClock& clock) {
  const auto i = size_t(cell);
  const uint8_t cut_byte = to_byte(cut), burn_byte = to_byte(burn);
  if (cut_byte == 0 && burn_byte == 0) return false;
  const bool ended = end_regrowth(tile, i, clock.now);
  if (tile.lasting && cut_byte <= tile.lasting->cut[i] && burn_byte <= tile.lasting->burn[i]) return ended;
  LastingPlane& plane = made(tile.lasting);
  plane.cut[i] = std::max(plane.cut[i], cut_byte);
  plane.burn[i] = std::max(plane.burn[i], burn_byte);
  return true;
}

bool touch_paint(DisturbanceTile& tile, int cell, glm::vec4 paint, const CellClock& clock) {
  if (to_byte(paint.a) == 0) return false;
  const bool ended = end_regrowth(tile, size_t(cell), clock.now);
  // Paint covers in its share of what is there in the end, so that painting twice is painting once.
  std::array<uint8_t, 4> there{};
  if (tile.paint) there = tile.paint->paint[size_t(cell)];
  const float before = float(there[3]) / 255.0f, after = std::max(before, paint.a);
  const float share = paint.a / after;
  std::array<uint8_t, 4> bytes{};
  for (size_t c = 0; c < 3; ++c) {
    const float old = before > 0 ? float(there[c]) / 255.0f / before : 0.0f;
    bytes[c] = to_byte((old + (paint[int(c)] - old) * share) * after);
  }
  bytes[3] = to_byte(after);
  if (bytes == there) return ended;
  made(tile.paint).paint[size_t(cell)] = bytes;
  return true;
}

}  // namespace sward
