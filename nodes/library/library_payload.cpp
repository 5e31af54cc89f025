// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/library/library_payload.hpp"

#include <utility>

#include "nodes/descriptors/descriptor_index.hpp"
#include "nodes/library/check_library.hpp"

namespace posevote::library {
namespace {

void put_cloud(ByteWriter& out, const Cloud& cloud) {
  out.put_matrix(cloud.points);
  out.put_matrix(cloud.normals);
}

void put_numbers(ByteWriter& out, const std::vector<std::uint32_t>& numbers) {
  out.put(std::uint64_t{numbers.size()});
  for (const std::uint32_t number : numbers) out.put(number);
}

void put_model(ByteWriter& out, const Model& model) {
  out.put(model.name);
  out.put(std::int32_t{model.obj_id});
  put_cloud(out, model.cloud);
  out.put_matrix(model.features.points);
  out.put_matrix(model.features.normals);
  out.put_matrix(model.features.descriptors);
  put_numbers(out, model.features.blocks);
  out.put_matrix(model.center);
  out.put(model.diagonal);
  out.put(std::uint64_t{model.near_symmetries.items.size()});
  for (const NearSymmetry& one : model.near_symmetries.items) {
    out.put_matrix(Eigen::Matrix4d(one.motion.matrix()));
    put_numbers(out, one.carried_off);
    put_numbers(out, one.uncovered);
  }
  out.put(model.outline.reach);
  out.put(std::string_view(reinterpret_cast<const char*>(model.outline.ends.data()),
                           model.outline.ends.size()));
}

std::vector<std::uint32_t> get_numbers(ByteReader& in) {
  std::vector<std::uint32_t> numbers;
  const auto count = in.get<std::uint64_t>();
  for (std::uint64_t i = 0; i < count; ++i) numbers.push_back(in.get<std::uint32_t>());
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

Cloud get_cloud(ByteReader& in) {
  Cloud cloud;
  cloud.points = in.get_matrix<PointMatrix>();
  cloud.normals = in.get_matrix<PointMatrix>();
  return cloud;
}

Model get_model(ByteReader& in) {
  Model model;
  model.name = in.get_text();
  model.obj_id = in.get<std::int32_t>();
  model.cloud = get_cloud(in);
  model.features.points = in.get_matrix<PointMatrix>();
  model.features.normals = in.get_matrix<PointMatrix>();
  model.features.descriptors = in.get_matrix<DescriptorMatrix>();
  model.features.blocks = get_numbers(in);
  model.center = get_vector(in);
  model.diagonal = in.get<float>();
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
  return model;
}

}  // namespace

std::string encode_library(const ModelLibrary& library) {
  check_library(library);
  if (!library.index) throw std::runtime_error("the library has no index");
  ByteWriter out;
  out.put(library.scale.resolution);
  const descriptors::IndexOptions& options = library.index->options();
  out.put(options.search);
  out.put(std::int32_t{options.trees});
  out.put(std::int32_t{options.checks});
  out.put(std::uint64_t{library.models.size()});
  for (const auto& model : library.models) put_model(out, *model);
  out.put(std::uint64_t{library.left_out.size()});
  for (const LeftOutModel& model : library.left_out) {
    out.put(model.name);
    out.put(std::int32_t{model.obj_id});
    out.put(model.why);
  }
  return out.bytes();
}

ModelLibrary decode_library(std::string_view bytes) {
  ByteReader in(bytes);
  ModelLibrary library;
  library.scale.resolution = in.get<float>();
  descriptors::IndexOptions options;
  options.search = in.get_text();
  options.trees = in.get<std::int32_t>();
  options.checks = in.get<std::int32_t>();
  const auto count = in.get<std::uint64_t>();
  for (std::uint64_t i = 0; i < count; ++i)
    library.models.push_back(std::make_shared<const Model>(get_model(in)));
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
    library.index = descriptors::index_of(library.models, options);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(std::string("is damaged: ") + error.what());
  }
  return library;
}

}  // namespace posevote::library
