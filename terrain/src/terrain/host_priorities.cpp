// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain/host_priorities.h>

#include <cmath>
#include <string>

namespace sward {

namespace {

bool finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::string name_of(const char* what, uint64_t id) {
  return "named " + std::string(what) + " " + std::to_string(id);
}

}  // namespace

Expected<HostPriorities::Place> HostPriorities::place_of(const NamedPoint& point) const {
  const std::string name = name_of("point", point.id);
  if (!finite({point.xy, 0})) return fail(name + ": its coordinates must be finite");
  if (!(point.tolerance_m >= 0) || !std::isfinite(point.tolerance_m))
    return fail(name + ": its tolerance must be 0 or a positive number of metres");
  const glm::dvec2 lattice = lattice_.from_world(point.xy);
  if (std::isnan(lattice.x)) {
    return fail(name + " at " + std::to_string(point.xy.x) + ", " + std::to_string(point.xy.y) +
                " lies outside of the data; remove it while its object is there");
  }
  return Place{Kind::point, lattice, lattice, 0, 0, point.tolerance_m};
}

Expected<HostPriorities::Place> HostPriorities::place_of(const NamedLine& line) const {
  if (!finite(line.from) || !finite(line.to))
    return fail(name_of("line", line.id) + ": its coordinates must be finite");
  const glm::dvec2 from = lattice_.extended_from_world(line.from), to = lattice_.extended_from_world(line.to);
  return Place{Kind::line, from, to, line.from.z, line.to.z, 0};
}

Expected<void> HostPriorities::add(const NamedPoint& point) {
  return add(point.id, place_of(point));
}

Expected<void> HostPriorities::add(const NamedLine& line) {
  return add(line.id, place_of(line));
}

Expected<void> HostPriorities::move(const NamedPoint& point) {
  return move(point.id, place_of(point));
}

Expected<void> HostPriorities::move(const NamedLine& line) {
  return move(line.id, place_of(line));
}

Expected<void> HostPriorities::add(uint64_t id, const Expected<Place>& place) {
  if (!place) return tl::unexpected<Error>(place.error());
  if (contains(id)) return fail("the id " + std::to_string(id) + " already names a point or a line; move it instead");
  uint32_t slot = uint32_t(slots_.size());
  if (free_.empty()) {
    slots_.emplace_back();
  } else {
    slot = free_.back();
    free_.pop_back();
  }
  slots_by_id_[id] = slot;
  set(slot, *place);
  return {};
}

Expected<void> HostPriorities::move(uint64_t id, const Expected<Place>& place) {
  if (!place) return tl::unexpected<Error>(place.error());
  const auto found = slots_by_id_.find(id);
  const char* kind = place->kind == Kind::point ? "point" : "line";
  if (found == slots_by_id_.end() || slots_[found->second].place.kind != place->kind)
    return fail("there is no " + name_of(kind, id) + " to move; add it first");
  if (slots_[found->second].place != *place) set(found->second, *place);
  return {};
}

Expected<void> HostPriorities::remove(uint64_t id) {
  const auto found = slots_by_id_.find(id);
  if (found == slots_by_id_.end()) return fail("no named point or line has the id " + std::to_string(id));
  set(found->second, {});
  free_.push_back(found->second);
  slots_by_id_.erase(found);
  return {};
}

void HostPriorities::clear() {
  for (const auto& [id, slot] : slots_by_id_) {
    set(slot, {});
    free_.push_back(slot);
  }
  slots_by_id_.clear();
}

// To the front of the list.
void HostPriorities::set(uint32_t slot, const Place& place) {
  Slot& s = slots_[slot];
  s.place = place;
  s.revision = ++revision_;
  if (newest_ == slot) return;
  if (s.newer != k_no_slot) slots_[s.newer].older = s.older;
  if (s.older != k_no_slot) slots_[s.older].newer = s.newer;
  s.newer = k_no_slot;
  s.older = newest_;
  if (newest_ != k_no_slot) slots_[newest_].newer = slot;
  newest_ = slot;
}

}  // namespace sward
