// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/library/library_payload.hpp"

#include <memory>
#include <utility>
#include <vector>

#include "graph/parallel.hpp"
#include "nodes/descriptors/descriptor_index.hpp"
#include "nodes/geometry/extreme_points.hpp"
#include "nodes/library/check_library.hpp"
#include "nodes/pairs/pair_table.hpp"

namespace posevote::library {
namespace {

void put_cloud(ByteWriter& out, const Cloud& cloud) {
  out.put_matrix(cloud.points);
  out.put_matrix(cloud.normals);
  out.put_matrix(cloud.colors);
}

void put_numbers(ByteWriter& out, const std::vector<std::uint32_t>& numbers) {
  out.put(std::uint64_t{numbers.size()});
  out.put_all(numbers.data(), numbers.size());
}

void put_features(ByteWriter& out, const FeatureSet& features) {
  out.put_matrix(features.points);
  out.put_matrix(features.normals);
  put_numbers(out, features.blocks);
  const std::vector<Octave> octaves = octaves_of(features);
  out.put(std::uint64_t{octaves.size()});
  for (const Octave& octave : octaves) {
    out.put(octave.resolution);
    out.put(octave.begin);
    out.put(octave.end);
    out.put_matrix(descriptors_of(features, octave));
  }
}

void put_symmetries(ByteWriter& out, const Symmetries& symmetries) {
  out.put_matrix(symmetries.fixed_point);
  out.put(std::uint64_t{symmetries.turns.size()});
  for (const Eigen::Quaternionf& turn : symmetries.turns) out.put_matrix(turn.coeffs());
  out.put(std::uint64_t{symmetries.axes.size()});
  for (const Eigen::Vector3f& axis : symmetries.axes) out.put_matrix(axis);
}

void put_model(ByteWriter& out, const Model& model) {
  out.put(model.name);
  out.put(std::int32_t{model.obj_id});
  out.put(model.resolution);
  put_cloud(out, model.cloud);
  put_features(out, model.features);
  out.put_matrix(model.center);
  out.put(model.diagonal);
  put_symmetries(out, model.symmetries);
  put_symmetries(out, model.shape_symmetries);
  out.put(std::uint64_t{model.near_symmetries.items.size()});
  for (const NearSymmetry& one : model.near_symmetries.items) {
    out.put_matrix(Eigen::Matrix4d(one.motion.matrix()));
    put_numbers(out, one.carried_off);
    put_numbers(out, one.uncovered);
  }
  out.put(model.outline.reach);
  out.put(std::string_view(reinterpret_cast<const char*>(model.outline.ends.data()),
                           model.outline.ends.size()));
  out.put(model.outline.gap_reach);
  out.put(std::string_view(reinterpret_cast<const char*>(model.outline.gaps.data()),
                           model.outline.gaps.size()));
  put_numbers(out, model.outline.bends);
  out.put(model.pairs ? model.pairs->step() : 0.0F);  // made anew when it is read
  out.put(model.rims ? model.rims->step() : 0.0F);    // likewise
  out.put(std::uint64_t{model.coarser.size()});
  for (const auto& octave : model.coarser) put_model(out, *octave);
}

std::vector<std::uint32_t> get_numbers(ByteReader& in) {
  const auto count = in.get<std::uint64_t>();
  if (count > in.rest().size() / sizeof(std::uint32_t))
    throw std::runtime_error("is damaged: it ends within a list of numbers");
  std::vector<std::uint32_t> numbers(count);
  in.get_all(numbers.data(), count);
  return numbers;
}

Eigen::Vector3f get_vector(ByteReader& in) {
  const auto values = in.get_matrix<Eigen::VectorXf>();
  if (values.size() != 3) throw std::runtime_error("is damaged: a vector is not of length 3");
  return values;
}

Eigen::Isometry3d get_motion(ByteReader& in) {
  const auto values = in.get_matrix<Eigen::MatrixXd>();
  if (values.rows() != 4 || values.cols() != 4)
    throw std::runtime_error("is damaged: a motion is not of 4 x 4 numbers");
  return Eigen::Isometry3d(Eigen::Matrix4d(values));
}

Symmetries get_symmetries(ByteReader& in) {
  Symmetries symmetries;
  symmetries.fixed_point = get_vector(in);
  symmetries.turns.clear();
  const auto turns = in.get<std::uint64_t>();
  for (std::uint64_t i = 0; i < turns; ++i) {
    const auto values = in.get_matrix<Eigen::VectorXf>();
    if (values.size() != 4) throw std::runtime_error("is damaged: a turn is not of 4 numbers");
    symmetries.turns.emplace_back(Eigen::Vector4f(values));
  }
  const auto axes = in.get<std::uint64_t>();
  for (std::uint64_t i = 0; i < axes; ++i) symmetries.axes.push_back(get_vector(in));
  return symmetries;
}

Cloud get_cloud(ByteReader& in) {
  Cloud cloud;
  cloud.points = in.get_matrix<PointMatrix>();
  cloud.normals = in.get_matrix<PointMatrix>();
  cloud.colors = in.get_matrix<ColorMatrix>();
  return cloud;
}

FeatureSet get_features(ByteReader& in) {
  FeatureSet features;
  features.points = in.get_matrix<PointMatrix>();
  features.normals = in.get_matrix<PointMatrix>();
  features.blocks = get_numbers(in);
  const auto octaves = in.get<std::uint64_t>();
  for (std::uint64_t i = 0; i < octaves; ++i) {
    Octave& octave = features.octaves.emplace_back();
    octave.resolution = in.get<float>();
    octave.begin = in.get<std::uint32_t>();
    octave.end = in.get<std::uint32_t>();
    octave.descriptors =
        std::make_shared<const DescriptorMatrix>(in.get_matrix<DescriptorMatrix>());
  }
  return features;
}

/// A model that was read, and the steps of its indices, which are made anew; 0: it has none.
struct Unindexed {
  std::shared_ptr<Model> model;
  float pair_step = 0, rim_step = 0;
};

/// Adds it and its coarser octaves, which have none themselves, to `all`.
std::shared_ptr<const Model> get_model(ByteReader& in, std::vector<Unindexed>& all, int depth = 0) {
  const auto read = std::make_shared<Model>();
  Model& model = *read;
  model.name = in.get_text();
  model.obj_id = in.get<std::int32_t>();
  model.resolution = in.get<float>();
  model.cloud = get_cloud(in);
  model.features = get_features(in);
  model.center = get_vector(in);
  model.diagonal = in.get<float>();
  model.symmetries = get_symmetries(in);
  model.shape_symmetries = get_symmetries(in);
  const auto near_symmetries = in.get<std::uint64_t>();
  for (std::uint64_t i = 0; i < near_symmetries; ++i) {
    NearSymmetry& one = model.near_symmetries.items.emplace_back();
    one.motion = get_motion(in);
    one.carried_off = get_numbers(in);
    one.uncovered = get_numbers(in);
  }
  model.outline.reach = in.get<float>();
  const std::string_view ends = in.get_text();
  model.outline.ends.assign(ends.begin(), ends.end());
  model.outline.gap_reach = in.get<float>();
  const std::string_view gaps = in.get_text();
  model.outline.gaps.assign(gaps.begin(), gaps.end());
  model.outline.bends = get_numbers(in);
  const auto pair_step = in.get<float>();
  const auto rim_step = in.get<float>();
  all.push_back({read, pair_step, rim_step});
  const auto coarser = in.get<std::uint64_t>();
  if (depth > 0 && coarser > 0) throw std::runtime_error("is damaged: an octave has octaves");
  for (std::uint64_t i = 0; i < coarser; ++i)
    model.coarser.push_back(get_model(in, all, depth + 1));
  return read;
}

void make_indices(const Unindexed& read) {
  Model& model = *read.model;
  model.outline.hull = geometry::extreme_points(model.cloud.points).cast<float>();
  if (read.pair_step != 0) model.pairs = pairs::index_pairs(model, read.pair_step);
  if (read.rim_step != 0) model.rims = pairs::index_rims(model, read.rim_step);
}

}  // namespace

std::string encode_library(const ModelLibrary& library) {
  std::string bytes;
  encode_library(library, [&](std::string_view piece) { bytes += piece; });
  return bytes;
}

void encode_library(const ModelLibrary& library,
                    const std::function<void(std::string_view piece)>& sink) {
  check_library(library);
  if (library.octaves.empty()) throw std::runtime_error("the library has no index");
  ByteWriter out;
  const descriptors::IndexOptions& options = library.octaves[0].index->options();
  out.put(options.search);
  out.put(std::int32_t{options.trees});
  out.put(std::int32_t{options.checks});
  out.put(std::uint64_t{library.models.size()});
  for (const auto& model : library.models) {
    put_model(out, *model);
    sink(out.take());
  }
  out.put(std::uint64_t{library.left_out.size()});
  for (const LeftOutModel& model : library.left_out) {
    out.put(model.name);
    out.put(std::int32_t{model.obj_id});
    out.put(model.why);
  }
  sink(out.take());
}

ModelLibrary decode_library(std::string_view bytes) {
  ByteReader in(bytes);
  ModelLibrary library;
  descriptors::IndexOptions options;
  options.search = in.get_text();
  options.trees = in.get<std::int32_t>();
  options.checks = in.get<std::int32_t>();
  const auto count = in.get<std::uint64_t>();
  std::vector<Unindexed> read;
  for (std::uint64_t i = 0; i < count; ++i) library.models.push_back(get_model(in, read));
  graph::parallel_for(read.size(), 1, [&](std::size_t i) { make_indices(read[i]); });
  const auto left_out = in.get<std::uint64_t>();
  for (std::uint64_t i = 0; i < left_out; ++i) {
    LeftOutModel& model = library.left_out.emplace_back();
    model.name = in.get_text();
    model.obj_id = in.get<std::int32_t>();
    model.why = in.get_text();
  }
  if (!in.rest().empty()) throw std::runtime_error("is damaged: it goes on after its end");
  try {
    check_library(library);
    library.octaves = descriptors::index_octaves(library.models, options);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(std::string("is damaged: ") + error.what());
  }
  return library;
}

}  // namespace posevote::library
