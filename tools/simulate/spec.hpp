// SPDX-License-Identifier: BSD-3-Clause
// What to simulate, read from YAML: see configs/demo_scenes.yaml.
#pragma once

#include <string>
#include <vector>

namespace posevote {

struct ModelSpec {
  std::string shape;          ///< of shape_names(); empty where there is a file
  std::string file;           ///< a mesh of one's own, in any format that models come in
  std::string unit = "auto";  ///< of the file's lengths
  int seed = 1;
  double size = 0.2;           ///< longest side of the bounding box [m]
  double x = 0, y = 0, z = 0;  ///< all three sides, where given: the shape is stretched to them [m]
};

inline constexpr double kSensorsOwn = -1;

/// One image, or several of a kind.
struct SceneSpec {
  int count = 1;                 ///< images, each with another arrangement of its bodies
  std::string ground = "table";  ///< or "bin", or "unseen"
  std::string sensor = "laser";  ///< of sensor_names(), or the file of another (sensor_file.hpp)
  double noise = kSensorsOwn;  ///< deviation of ranges at any distance, instead of the sensor's [m]
  double inexact = 0;          ///< real things are stretched along each axis by up to this share
  std::vector<int> objects;    ///< obj_id of each instance
  int clutter = 3;             ///< bodies that are no models
  bool objects_below = false;  ///< they are dropped before all clutter, not in mixed order
  double radius = 0.15;        ///< within which bodies are dropped; of a bin, half its side [m]
  double least_surface = 0;    ///< that is seen of each object's; else bodies are dropped anew
  double most_surface = 1;     ///< likewise
  double distance = 0.9;       ///< from sensor to the middle of the table [m]
  double elevation = 50;       ///< of the sensor above the table [deg]
  double azimuth = 0;          ///< [deg]
};

struct Spec {
  int seed = 1;
  bool colors = false;         ///< things are painted, and photographed beside the scan
  double least_visible = 0.1;  ///< share of an instance's pixels; less visible ones do not count
  double clutter_size = 0.2;   ///< longest side of the largest clutter; the least is 0.4 of it [m]
  std::vector<ModelSpec> models;  ///< obj_id 1, 2 ...
  std::vector<SceneSpec> scenes;  ///< one an image: those of a kind are repeated
};

/// Files that it names are sought from its own folder. Throws graph::ConfigError with every problem
/// of the file and its place.
Spec read_spec(const std::string& file);

}  // namespace posevote
