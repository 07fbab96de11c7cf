// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "sward/viewer/panel.h"

#include <imgui.h>

namespace sward::tool {

namespace {

// One row of statistics; a time that is not known shows as a dash.
void show_time(const char* name, std::optional<double> ms) {
  if (ms)
    ImGui::Text("%-18s %7.2f ms", name, *ms);
  else
    ImGui::Text("%-18s       -", name);
}

void show_world(const WorldStats& world) {
  ImGui::Text("world squares      %u of %u wanted, %.0f MB", world.resident, world.wanted,
              double(world.bytes) / (1 << 20));
  if (world.failing == 0) return;
  ImGui::TextColored({1, 0.6f, 0.3f, 1}, "%u squares fail", world.failing);
  ImGui::TextWrapped("%s", world.last_error.c_str());
}

void show_statistics(const host::SceneFrameStats& stats, double frame_ms) {
  if (!ImGui::CollapsingHeader("Statistics", ImGuiTreeNodeFlags_DefaultOpen)) return;
  show_time("frame", frame_ms);
  show_time("ROAM (CPU)", stats.cpu_roam_ms);
  show_time("seeding (CPU)", stats.cpu_seeding_ms);
  show_time("terrain (GPU)", stats.gpu_terrain_ms);
  show_time("classify (GPU)", stats.gpu_classify_ms);
  show_time("grow (GPU)", stats.gpu_grow_ms);
  if (stats.clipmap) {
    ImGui::Text("terrain triangles  %u in %u blocks", stats.roam.visible, stats.clipmap->blocks);
    ImGui::Text("rings              %d to %d, %zu points read", stats.clipmap->finest, stats.clipmap->rings - 1,
                stats.clipmap->upload.points);
  } else {
    ImGui::Text("terrain triangles  %u (%u splits, %u merges)", stats.roam.visible, stats.roam.splits,
                stats.roam.merges);
    ImGui::Text("error bound        %.2f px", double(stats.bound_px));
  }
  if (stats.world) show_world(*stats.world);
  ImGui::Text("fixed triangles    %u", stats.fixed_triangles);
  ImGui::Text("clusters           %u of %u fertile", stats.vegetation.clusters_fertile,
              stats.vegetation.clusters_submitted);
}

void edit_camera(WalkCamera& camera) {
  if (!ImGui::CollapsingHeader("Camera", ImGuiTreeNodeFlags_DefaultOpen)) return;
  ImGui::Text("%.1f, %.1f, %.1f m", camera.position.x, camera.position.y, camera.position.z);
  ImGui::Checkbox("walk (F)", &camera.walking);
  float fov = float(glm::degrees(camera.fov_y));
  if (ImGui::SliderFloat("field of view", &fov, 5, 110, "%.0f deg")) camera.fov_y = glm::radians(double(fov));
  float speed = float(camera.speed);
  if (ImGui::SliderFloat("speed", &speed, 1, 100, "%.0f m/s")) camera.speed = speed;
}

void edit_light_and_budget(PanelState& state) {
  if (ImGui::CollapsingHeader("Sun and haze", ImGuiTreeNodeFlags_DefaultOpen)) {
    ImGui::SliderFloat("azimuth", &state.sun_azimuth_degrees, -180, 180, "%.0f deg");
    ImGui::SliderFloat("elevation", &state.sun_elevation_degrees, -10, 90, "%.0f deg");
    ImGui::SliderFloat("season", &state.season, 0, 1, "%.3f");
    ImGui::SliderFloat("haze", &state.haze_distance_m, 500, 100000, "%.0f m", ImGuiSliderFlags_Logarithmic);
  }
  if (!state.has_mesh || !ImGui::CollapsingHeader("Terrain budget", ImGuiTreeNodeFlags_DefaultOpen)) return;
  state.budget_changed |=
      ImGui::SliderInt("triangles", &state.max_triangles, 1000, 200000, "%d", ImGuiSliderFlags_Logarithmic);
  state.budget_changed |= ImGui::SliderFloat("error target", &state.target_px, 0, 8, "%.1f px");
}

void edit_wind(PanelState& state) {
  if (!ImGui::CollapsingHeader("Wind", ImGuiTreeNodeFlags_DefaultOpen)) return;
  Weather& weather = state.weather;
  bool changed = ImGui::SliderFloat("wind", &weather.speed_m_s, 0, 40, "%.1f m/s");
  float from = glm::degrees(weather.from_azimuth);
  if (ImGui::SliderFloat("comes from", &from, -180, 180, "%.0f deg")) {
    weather.from_azimuth = glm::radians(from);
    changed = true;
  }
  changed |= ImGui::SliderFloat("gustiness", &weather.gustiness, 0, 1);
  changed |= ImGui::SliderFloat("gust length", &weather.gust_length_m, 5, 500, "%.0f m", ImGuiSliderFlags_Logarithmic);
  changed |= ImGui::SliderFloat("in calm", &weather.ambient_m_s, 0, 2, "%.2f m/s");
  state.weather_changed |= changed;
  ImGui::Checkbox("arrows (V)", &state.wind_arrows);
}

bool edit_range(const char* name, FloatRange& range, float most, const char* format) {
  return ImGui::DragFloatRange2(name, &range.min, &range.max, most / 400, 0.001f, most, format, nullptr,
                                ImGuiSliderFlags_AlwaysClamp);
}

bool edit_species(Species& species) {
  bool changed = false;
  float color[3] = {species.reference_hsv.x, species.reference_hsv.y, species.reference_hsv.z};
  if (ImGui::ColorEdit3("reference colour", color, ImGuiColorEditFlags_InputHSV | ImGuiColorEditFlags_DisplayHSV)) {
    species.reference_hsv = {color[0], color[1], color[2]};
    changed = true;
  }
  changed |= ImGui::SliderFloat("exponent", &species.exponent, 0.1f, 16);
  if (species.kind == PlantKind::none) return changed;
  changed |= edit_range("height", species.height_m, 2, "%.3f m");
  changed |= edit_range("width", species.width_m, 0.1f, "%.4f m");
  changed |= edit_range("stiffness", species.stiffness, 1, "%.2f");
  changed |= ImGui::SliderFloat("lean", &species.lean, 0, 1.2f, "%.2f rad");
  changed |= ImGui::SliderFloat("towards the sun", &species.phototropism, 0, 1);
  changed |= ImGui::SliderInt("segments", &species.max_segments, 1, 16);
  changed |= ImGui::ColorEdit3("tint", &species.tint.x, ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR);
  changed |= ImGui::ColorEdit3("age tint", &species.age_tint.x, ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR);
  changed |= ImGui::SliderFloat("age share", &species.age_share, 0, 1);
  changed |= ImGui::SliderFloat("translucency", &species.translucency, 0, 2);
  changed |= ImGui::SliderFloat("root shade", &species.root_shade, 0, 1);
  return changed;
}

bool edit_layer(Layer& layer) {
  bool changed = false;
  const ImGuiSliderFlags logarithmic = ImGuiSliderFlags_Logarithmic;
  changed |= ImGui::SliderFloat("density", &layer.density, 1, 100000, "%.0f", logarithmic);
  changed |= ImGui::SliderFloat("horizon", &layer.horizon_m, 10, 1000, "%.0f m", logarithmic);
  changed |= ImGui::SliderFloat("full density to", &layer.full_distance_m, 1, 50, "%.1f m");
  changed |= ImGui::Checkbox("shadows", &layer.shadows);
  ImGui::SameLine();
  changed |= ImGui::Checkbox("plain", &layer.plain);
  for (Species& species : layer.species) {
    if (!ImGui::TreeNode(species.name.c_str())) continue;
    changed |= edit_species(species);
    ImGui::TreePop();
  }
  return changed;
}

}  // namespace

void draw_panel(PanelState& state, WalkCamera& camera, const host::SceneFrameStats& stats, double frame_ms) {
  ImGui::SetNextWindowPos({12, 12}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({390, 640}, ImGuiCond_FirstUseEver);
  if (ImGui::Begin("sward")) {
    ImGui::TextWrapped("WASD move, E Q up down, Shift fast, right mouse look, F walk or fly, F5 reload");
    ImGui::TextWrapped(
        "At the place looked at: C cut, X burn, Z blast, T let grow again, G gust from here, H whirlwind, R rotor on "
        "or "
        "off, B roll a ball; V wind arrows");
    if (!state.message.empty()) ImGui::TextColored({1, 0.6f, 0.3f, 1}, "%s", state.message.c_str());
    show_statistics(stats, frame_ms);
    edit_camera(camera);
    edit_light_and_budget(state);
    edit_wind(state);
    ImGui::Checkbox("vegetation", &state.vegetation);
    for (size_t i = 0; i < state.layers.size(); ++i) {
      ImGui::PushID(int(i));
      if (ImGui::CollapsingHeader(("Layer " + state.layers[i].name).c_str()) && edit_layer(state.layers[i]))
        state.layer_changed[i] = true;
      ImGui::PopID();
    }
  }
  ImGui::End();
}

}  // namespace sward::tool
