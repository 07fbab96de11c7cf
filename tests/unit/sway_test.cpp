// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Blades in the wind, by the files that the shaders are made of: length, ground, direction, bounds, neighbours.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "unit/sway_support.h"

namespace sward {
namespace {

using namespace test;
using shared::PlantAir;
using shared::SwayTraits;

constexpr float k_degree = k_turn / 360;
// What the plants feel of winds of 0 to 60 m/s, and beyond.
const float k_winds[] = {0, 0.05f, 0.3f, 1, 2, 4, 8, 15, 30, 60, 90};

template <class Visit>
void each_blade(Visit visit) {
  for (float stiffness = 0; stiffness <= 1.0f; stiffness += 0.125f)
    for (const float azimuth : {0.0f, 1.0f, 2.2f, 3.0f, 3.14159f})
      for (const float lean : {0.0f, 0.15f, 0.6f})
        for (const float wind : k_winds) visit(Blade{stiffness, azimuth, lean}, glm::vec2(wind, 0));
}

TEST(Sway, KeepsTheLengthOfEveryNumberOfSegments) {
  float worst = 0, worst_fine = 0;
  each_blade([&](Blade blade, glm::vec2 wind) {
    for (const float segments : {1.0f, 2.0f, 3.0f, 5.0f, 7.0f, 16.0f}) {
      blade.segments = segments;
      const float calm = draw_blade(blade, {}).length(), blown = draw_blade(blade, wind).length();
      worst = std::max(worst, std::abs(blown / calm - 1));
    }
    blade.segments = 16;
    worst_fine = std::max(worst_fine, std::abs(draw_blade(blade, wind).length() - 1));
  });
  EXPECT_LT(worst, 0.01f);
  EXPECT_LT(worst_fine, 0.01f);
}

TEST(Sway, LiesOnTheGround) {
  float lowest = 0;
  each_blade([&](Blade blade, glm::vec2 wind) {
    for (const float slope : {-0.8f, -0.2f, 0.0f, 0.2f, 0.8f}) {
      blade.normal = glm::normalize(glm::vec3(-slope, 0.3f * slope, 1));
      for (const float segments : {1.0f, 3.0f, 7.0f, 16.0f}) {
        blade.segments = segments;
        const DrawnBlade drawn = draw_blade(blade, wind);
        for (const glm::vec3& p : drawn.points) lowest = std::min(lowest, glm::dot(p, blade.normal));
      }
    }
  });
  // A blade of a metre: less than a centimetre.
  EXPECT_GT(lowest, -0.01f);
}

TEST(Sway, BendsFartherTheStrongerTheWind) {
  for (float stiffness = 0.2f; stiffness <= 1.0f; stiffness += 0.1f) {
    for (float azimuth = 0; azimuth < k_turn; azimuth += 0.3f) {
      const Blade blade{stiffness, azimuth, 0.15f};
      float before = draw_blade(blade, {}).tip().x;
      for (float wind = 0.1f; wind < 60; wind *= 1.15f) {
        const float here = draw_blade(blade, {wind, 0}).tip().x;
        // Beyond the level the lean takes tips down, not on.
        EXPECT_GE(here, before - 0.008f) << stiffness << ' ' << azimuth << ' ' << wind;
        before = std::max(before, here);
      }
      EXPECT_GT(before, 0.75f);
    }
  }
}

TEST(Sway, IsContinuousInTheWind) {
  // A hair's breadth of wind moves no point by much, also where the wind just cancels the plant's own bend.
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(0, 1);
  float worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const Blade blade{unit(random), k_turn * unit(random), 0.4f * unit(random)};
    const float angle = k_turn * unit(random), strength = 6 * unit(random) * unit(random);
    const glm::vec2 wind = strength * glm::vec2(std::cos(angle), std::sin(angle));
    const glm::vec3 a = draw_blade(blade, wind).tip(), b = draw_blade(blade, wind + glm::vec2(1e-3f, 0)).tip();
    worst = std::max(worst, glm::distance(a, b));
  }
  EXPECT_LT(worst, 0.004f);
}

SwayTraits some_traits(std::mt19937& random, const shared::SpeciesParams& species, const Species& grass) {
  return shared::sway_traits(species, {grass.height_m.min, grass.height_m.max}, {random(), random()}, random() % 4096,
                             float(random() % 65536) / 65536);
}

shared::SpeciesParams params_of(const Species& grass) {
  Layer layer;
  layer.species = {grass};
  return make_species_params(layer)[0];
}

TEST(Sway, MeanBendFollowsTheWind) {
  const Species grass;
  const shared::SpeciesParams species = params_of(grass);
  for (const float speed : {1.0f, 3.0f, 8.0f, 15.0f, 25.0f, 60.0f}) {
    for (const float azimuth : {0.4f, 3.9f}) {
      std::mt19937 random(3);
      std::uniform_real_distribution<float> unit(0, 1);
      const glm::vec2 velocity = speed * glm::vec2(std::cos(azimuth), std::sin(azimuth));
      glm::vec2 mean(0);
      for (int i = 0; i < 6000; ++i) {
        const SwayTraits traits = some_traits(random, species, grass);
        const Blade blade{0.45f + 0.4f * unit(random), k_turn * unit(random), 0.15f * unit(random)};
        const PlantAir air = shared::plant_air(traits, 0.35f, blade.lean, velocity, glm::vec2(0), 0.5f, 12.0f, 1.0f);
        mean += glm::vec2(draw_blade(blade, shared::swaying_wind(air, 0)).tip());
      }
      const float off = std::atan2(mean.y, mean.x) - azimuth;
      EXPECT_LT(std::abs(std::remainder(off, k_turn)), 5 * k_degree) << speed;
    }
  }
}

TEST(Sway, NoGustBendsBeyondTheGustFactor) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> unit(0, 1);
  const Species grass;
  const shared::SpeciesParams species = params_of(grass);
  float worst = -1;
  for (int i = 0; i < 4000; ++i) {
    const SwayTraits traits = some_traits(random, species, grass);
    const Blade blade{unit(random), k_turn * unit(random), 0.3f * unit(random)};
    const glm::vec2 velocity(40 * unit(random) * unit(random), 0);
    const float gust = unit(random);
    float most = 0;
    PlantAir air{};
    for (float time = 0; time < 8; time += 0.21f) {
      air = shared::plant_air(traits, 0.35f, blade.lean, velocity, glm::vec2(0), gust, time, 1.0f);
      const glm::vec2 blown = shared::swaying_wind(air, 0);
      EXPECT_LE(glm::length(blown), shared::k_gust_factor * glm::length(air.wind) * 1.0001f);
      most = std::max(most, draw_blade(blade, blown).angle());
    }
    float bound = 0;  // a plant against the wind rises before it bends: of all winds up to the factor
    for (float share = 0; share <= 1.001f; share += 0.02f)
      bound = std::max(bound, draw_blade(blade, share * shared::k_gust_factor * air.wind).angle());
    worst = std::max(worst, most - bound);
  }
  EXPECT_LT(worst, 1 * k_degree);
}

/// Way of a blade's tip in the course of time, along and across the mean wind.
std::vector<glm::vec2> motion(const SwayTraits& traits, const Blade& blade, glm::vec2 velocity, float gust) {
  std::vector<glm::vec2> tips;
  for (float time = 100; time < 130; time += 0.05f) {
    const PlantAir air = shared::plant_air(traits, 0.35f, blade.lean, velocity, glm::vec2(0), gust, time, 1.0f);
    tips.emplace_back(draw_blade(blade, shared::swaying_wind(air, 0)).tip());
  }
  return tips;
}

float amplitude(const std::vector<glm::vec2>& tips) {
  float least = 9, most = -9;
  for (const glm::vec2& tip : tips) least = std::min(least, tip.x), most = std::max(most, tip.x);
  return most - least;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double ma = 0, mb = 0, ab = 0, aa = 0, bb = 0;
  for (size_t i = 0; i < a.size(); ++i) ma += a[i] / double(a.size()), mb += b[i] / double(b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - ma) * (b[i] - mb);
    aa += (a[i] - ma) * (a[i] - ma);
    bb += (b[i] - mb) * (b[i] - mb);
  }
  return ab / std::sqrt(aa * bb + 1e-30);
}

TEST(Sway, UprightPlantsSwayMore) {
  const SwayTraits traits{1.25f, 1.0f, 0.3f};
  const glm::vec2 velocity(8, 0);
  const float upright = amplitude(motion(traits, {0.8f, 0, 0.05f}, velocity, 0.5f));
  const float leaning = amplitude(motion(traits, {0.8f, 0, 1.0f}, velocity, 0.5f));
  const float lying = amplitude(motion(traits, {0.8f, 0, 1.45f}, velocity, 0.5f));
  EXPECT_GT(upright, 0.05f);
  EXPECT_GT(upright, 2 * leaning);
  EXPECT_GT(leaning, 2 * lying);
  // And one that strong wind has laid down trembles less than one that stands.
  EXPECT_GT(upright, 1.5f * amplitude(motion(traits, {0.8f, 0, 0.05f}, {60, 0}, 0.5f)));
}

TEST(Sway, StillAirLeavesThePostureAsItIs) {
  const SwayTraits traits{2.0f, 1.0f, 0.7f};
  for (float time = 0; time < 3; time += 0.1f) {
    const PlantAir air = shared::plant_air(traits, 0.3f, 0.1f, glm::vec2(0), glm::vec2(0), 0, time, 1.0f);
    const DrawnBlade drawn = draw_blade({0.7f, 2.0f, 0.1f}, shared::swaying_wind(air, 0));
    const DrawnBlade calm = draw_blade({0.7f, 2.0f, 0.1f}, glm::vec2(0));
    for (size_t i = 0; i < calm.points.size(); ++i) EXPECT_LT(glm::distance(drawn.points[i], calm.points[i]), 1e-6f);
  }
}

TEST(Sway, CyclesKeepTheirRateAndEndWhereTheyStart) {
  const Species grass;
  const shared::SpeciesParams species = params_of(grass);
  std::mt19937 random(5);
  for (int i = 0; i < 1000; ++i) {
    const SwayTraits traits = some_traits(random, species, grass);
    EXPECT_GT(traits.hertz, 0.5f);
    EXPECT_LT(traits.hertz, 4.0f);
    // Whatever wind, season or cutting do.
    const PlantAir weak = shared::plant_air(traits, 0.4f, 0.1f, {1, 0}, {}, 0.1f, 50.0f, 1.0f);
    const PlantAir strong = shared::plant_air(traits, 0.1f, 0.9f, {30, 9}, {1, 1}, 0.9f, 50.0f, 0.4f);
    EXPECT_EQ(weak.cycle, strong.cycle);
    EXPECT_EQ(weak.slow, strong.slow);
    const float around = 0.002f;  // a float of seconds after an hour
    const PlantAir first = shared::plant_air(traits, 0.4f, 0.1f, {1, 0}, {}, 0, 0.0f, 1.0f);
    const PlantAir last = shared::plant_air(traits, 0.4f, 0.1f, {1, 0}, {}, 0, 4096.0f, 1.0f);
    EXPECT_LT(std::abs(std::remainder(first.cycle - last.cycle, 1.0f)), around);
    EXPECT_LT(std::abs(std::remainder(first.slow - last.slow, 1.0f)), around);
  }
}

TEST(Sway, NoiseHasADirectionOfItsOwnForEachPlant) {
  glm::vec2 sum(0);
  for (int i = 0; i < 400; ++i) {
    const glm::vec2 own = shared::own_noise({0.2f, 0}, float(i) / 400);
    EXPECT_NEAR(glm::length(own), 0.2f / 1.12f, 1e-5f);
    sum += own / 400.0f;
  }
  EXPECT_LT(glm::length(sum), 0.002f);
  // And what is too quick for plants stays below the wind that carries it.
  EXPECT_LT(glm::length(shared::own_noise({30, 0}, 0.1f)), 1.0f / 0.6f);
}

/// Ways of neighbours' tips along the wind, sampled for a minute, in a sward::Wind.
std::vector<std::vector<double>> neighbours(const Weather& weather, glm::vec2 along, int count) {
  Wind wind;
  EXPECT_TRUE(wind.set_weather(weather));
  const Species grass;
  const shared::SpeciesParams species = params_of(grass);
  std::mt19937 random(17);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<SwayTraits> traits;
  std::vector<Blade> blades;
  for (int i = 0; i < count; ++i) {
    traits.push_back(some_traits(random, species, grass));
    blades.push_back({0.45f + 0.4f * unit(random), k_turn * unit(random), 0.15f * unit(random)});
  }
  std::vector<std::vector<double>> ways{size_t(count)};
  for (int step = 0; step < 900; ++step) {
    EXPECT_TRUE(wind.advance(1 / 15.0, glm::dvec3(0)));
    for (int i = 0; i < count; ++i) {
      const float own = k_turn * 11 * traits[size_t(i)].phase;
      const glm::dvec3 place(0.1 * i + 0.35 * std::cos(own), 0.35 * std::sin(own), 0);
      const WindHere here = wind.at(place);
      const PlantAir air = shared::plant_air(traits[size_t(i)], 0.35f, blades[size_t(i)].lean, here.velocity,
                                             here.ambient, here.gust, float(wind.time()), 1.0f);
      const DrawnBlade drawn = draw_blade(blades[size_t(i)], shared::swaying_wind(air, 0));
      ways[size_t(i)].push_back(glm::dot(glm::vec2(drawn.tip()), along));
    }
  }
  return ways;
}

double mean_correlation(const std::vector<std::vector<double>>& ways) {
  double sum = 0;
  for (size_t i = 1; i < ways.size(); ++i) sum += correlation(ways[i - 1], ways[i]) / double(ways.size() - 1);
  return sum;
}

TEST(Sway, NeighboursAreOutOfStep) {
  Weather steady{.speed_m_s = 8, .from_azimuth = 3.14159265f, .gustiness = 0, .ambient_m_s = 0, .turbulence = 0};
  const double in_wind = mean_correlation(neighbours(steady, {1, 0}, 40));
  Weather gusty;
  gusty.speed_m_s = 8;
  gusty.from_azimuth = 3.14159265f;
  const double in_gusts = mean_correlation(neighbours(gusty, {1, 0}, 40));
  const double in_calm = mean_correlation(neighbours(Weather(), {1, 0}, 40));
  RecordProperty("steady", std::to_string(in_wind));
  RecordProperty("gusts", std::to_string(in_gusts));
  RecordProperty("ambient", std::to_string(in_calm));
  printf("correlation of neighbours: steady wind %.3f, gusts %.3f, ambient %.3f\n", in_wind, in_gusts, in_calm);
  EXPECT_LT(std::abs(in_wind), 0.15);
  EXPECT_LT(in_gusts, 0.9);
  EXPECT_LT(std::abs(in_calm), 0.3);
  EXPECT_LT(std::abs(in_calm), in_gusts);
}

}  // namespace
}  // namespace sward
