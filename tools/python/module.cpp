// SPDX-License-Identifier: BSD-3-Clause
// The Python module: pipelines/recognizer.hpp with NumPy arrays. What is fit to read as it lies in
// memory (32-bit floats, C order) is not copied; the interpreter runs on while it works.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <stdexcept>

#include "pipelines/recognizer.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace posevote {
namespace {

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Indices = py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>;

[[noreturn]] void refuse(const std::string& what, const py::array& array) {
  throw std::invalid_argument(what + ", not " +
                              py::cast<std::string>(py::str(array.attr("shape"))));
}

/// Rows of three: n x 3, or the h x w x 3 of an organised cloud.
std::size_t rows_of(const py::array& array, const std::string& name) {
  if (array.ndim() < 2 || array.shape(array.ndim() - 1) != 3)
    refuse(name + " must be n x 3 or h x w x 3", array);
  return static_cast<std::size_t>(array.size()) / 3;
}

template <class Array>
auto values_of(const Array& array, const std::string& name) {
  rows_of(array, name);
  return std::vector<typename Array::value_type>(array.data(), array.data() + array.size());
}

/// A file's name, (points, faces), a dict, or what has vertices and faces or triangles, as the
/// meshes of trimesh and Open3D.
ObjectModel to_model(const py::handle& object) {
  ObjectModel model;
  if (py::isinstance<py::str>(object) || py::hasattr(object, "__fspath__"))
    return ObjectModel::from_file(
        py::cast<std::string>(py::module_::import("os").attr("fspath")(object)));
  const auto take = [&](const char* name, const py::handle& value) {
    const std::string key = name;
    if (key == "points")
      model.points = values_of(Floats::ensure(value), "points");
    else if (key == "normals")
      model.normals = values_of(Floats::ensure(value), "normals");
    else
      model.faces = values_of(Indices::ensure(value), "faces");
  };
  if (py::isinstance<py::dict>(object)) {
    for (const auto& [key, value] : py::reinterpret_borrow<py::dict>(object)) {
      const auto name = py::cast<std::string>(key);
      if (name == "name")
        model.name = py::cast<std::string>(value);
      else if (name == "obj_id")
        model.obj_id = py::cast<int>(value);
      else if (name == "file")
        model.file = py::cast<std::string>(py::module_::import("os").attr("fspath")(value));
      else if (name == "points" || name == "normals" || name == "faces")
        take(name.c_str(), value);
      else
        throw std::invalid_argument("a model has no '" + name +
                                    "', expected file, points, normals, faces, name or obj_id");
    }
    return model;
  }
  const auto attribute = [&](const char* as, std::initializer_list<const char*> names) {
    for (const char* name : names)
      if (py::hasattr(object, name) && py::len(object.attr(name)) > 0) {
        take(as, object.attr(name));
        return true;
      }
    return false;
  };
  if (attribute("points", {"vertices", "points"})) {
    attribute("faces", {"faces", "triangles"});
    return model;
  }
  if (py::isinstance<py::array>(object)) return take("points", object), model;
  throw py::type_error(
      "a model is a file's name, an n x 3 array, a dict or a mesh with vertices, not " +
      py::cast<std::string>(py::str(py::type::of(object))));
}

std::vector<ObjectModel> to_models(const py::handle& models) {
  if (py::isinstance<py::str>(models)) return {to_model(models)};
  std::vector<ObjectModel> list;
  for (const py::handle& model : models) list.push_back(to_model(model));
  return list;
}

Doubles matrix(const Matrix4& rows) {
  Doubles array({4, 4});
  std::copy(rows.begin(), rows.end(), array.mutable_data());
  return array;
}

py::object covariance(const FoundObject& found) {
  if (!found.covariance) return py::none();
  Doubles array({6, 6});
  std::copy(found.covariance->begin(), found.covariance->end(), array.mutable_data());
  return array;
}

/// Where the sensor stood: x y z, or the 4 x 4 pose of it in the cloud's frame.
std::optional<std::array<double, 3>> sensor_place(const std::optional<Doubles>& sensor) {
  if (!sensor) return std::nullopt;
  const double* at = sensor->data();
  if (sensor->ndim() == 1 && sensor->size() == 3) return std::array{at[0], at[1], at[2]};
  if (sensor->ndim() == 2 && sensor->shape(0) == 4 && sensor->shape(1) == 4)
    return std::array{at[3], at[7], at[11]};
  refuse("sensor must be x y z or a 4 x 4 matrix", *sensor);
}

Recognition detect_points(const Recognizer& recognizer, const Floats& points,
                          const std::optional<Floats>& normals,
                          const std::optional<Doubles>& sensor) {
  PointCloud cloud;
  cloud.points = points.data();
  cloud.count = rows_of(points, "points");
  if (normals) {
    if (rows_of(*normals, "normals") != cloud.count)
      refuse("normals must be one a point, as points", *normals);
    cloud.normals = normals->data();
  }
  const auto place = sensor_place(sensor);
  if (place) cloud.sensor = place->data();
  const py::gil_scoped_release others_run;
  return recognizer.recognize(cloud);
}

/// `scale`: metres a unit, by default of what the numbers are.
Recognition detect_depth(const Recognizer& recognizer, const py::array& depth, const Doubles& K,
                         const std::optional<double>& scale) {
  if (depth.ndim() != 2) refuse("depth must be h x w", depth);
  if (K.ndim() != 2 || K.shape(0) != 3 || K.shape(1) != 3) refuse("K must be 3 x 3", K);
  DepthView image;
  image.height = static_cast<std::size_t>(depth.shape(0));
  image.width = static_cast<std::size_t>(depth.shape(1));
  image.camera = {K.at(0, 0), K.at(1, 1), K.at(0, 2), K.at(1, 2)};
  py::array kept;  // what a conversion makes must live until the end
  if (py::isinstance<py::array_t<std::uint16_t>>(depth)) {
    const auto raw = py::array_t<std::uint16_t, py::array::c_style>::ensure(depth);
    image.raw = raw.data();
    image.millimetres_per_unit = 1000 * scale.value_or(0.001);
    kept = raw;
  } else {
    const auto metres = Floats::ensure(scale ? py::array(depth * py::float_(*scale)) : depth);
    image.metres = metres.data();
    kept = metres;
  }
  const py::gil_scoped_release others_run;
  return recognizer.recognize(image);
}

Recognition detect(const Recognizer& recognizer, const py::object& points,
                   const std::optional<Floats>& normals, const std::optional<Doubles>& sensor,
                   const std::optional<py::array>& depth, const std::optional<Doubles>& K,
                   const std::optional<double>& depth_scale, const py::object& file) {
  if (int(!points.is_none()) + int(depth.has_value()) + int(!file.is_none()) != 1)
    throw std::invalid_argument("expected points=, depth= with K=, or file=, one of them");
  if (!file.is_none()) {
    const auto name = py::cast<std::string>(py::module_::import("os").attr("fspath")(file));
    const py::gil_scoped_release others_run;
    return recognizer.recognize_file(name);
  }
  if (depth) {
    if (!K) throw std::invalid_argument("depth= needs K=, the 3 x 3 matrix of its camera");
    return detect_depth(recognizer, *depth, *K, depth_scale);
  }
  const Floats array =
      Floats::ensure(py::hasattr(points, "points") ? points.attr("points") : points);
  if (!array) throw py::error_already_set();
  return detect_points(recognizer, array, normals, sensor);
}

}  // namespace

PYBIND11_MODULE(_posevote, module) {
  module.attr("__version__") = version();

  py::class_<FoundObject>(module, "Detection", "One found instance of one object.")
      .def_readonly("name", &FoundObject::name, "The model's name.")
      .def_readonly("obj_id", &FoundObject::obj_id)
      .def_readonly("confidence", &FoundObject::confidence,
                    "In [0, 1]: the probability that it is right.")
      .def_property_readonly(
          "T", [](const FoundObject& found) { return matrix(found.T_scene_model); },
          "4 x 4, metres: takes a point of the model's file to the scan's frame.")
      .def_property_readonly(
          "covariance", &covariance,
          "6 x 6, of xi in T_true = T exp(xi): a translation [m], then a rotation vector [rad], in "
          "the model's frame, about its origin. None: the pose was not refined.")
      .def_property_readonly(
          "symmetries",
          [](const FoundObject& found) {
            py::list turns;
            for (const Matrix4& turn : found.symmetries) turns.append(matrix(turn));
            return turns;
          },
          "4 x 4 matrices S for which T @ S is as good a pose; the identity is first.")
      .def_readonly(
          "pose_confidence", &FoundObject::pose_confidence,
          "As confidence, look_alikes counted as wrong, and other objects that fit there.")
      .def_property_readonly(
          "look_alikes",
          [](const FoundObject& found) {
            py::list others;
            for (const LookAlikePose& other : found.look_alikes)
              others.append(py::make_tuple(matrix(other.T_scene_model), other.probability));
            return others;
          },
          "Other poses that the scan does not tell from T: pairs of a 4 x 4 matrix and the "
          "probability that it is the right one, given that the object lies there.")
      .def_readonly("axes", &FoundObject::axes,
                    "Axes of continuous symmetry in the model's frame, through axis_point.")
      .def_readonly("axis_point", &FoundObject::axis_point, "[m]")
      .def_readonly("inlier_share", &FoundObject::inlier_share,
                    "Share of the model's points that face the sensor and lie on scan points.")
      .def_readonly("rms", &FoundObject::rms, "Of the inliers' distance to the scan [m].")
      .def_readonly("seconds", &FoundObject::seconds,
                    "Spent on the search for it, since the object's instance before.")
      .def("__repr__", [](const FoundObject& found) {
        return "<posevote.Detection " + found.name + ", confidence " +
               py::cast<std::string>(py::str("{:.2f}").format(found.confidence)) + ">";
      });

  py::class_<Recognition>(module, "Recognition", "The answer to one scan: a sequence of Detection.")
      .def_readonly("found", &Recognition::found, "In descending order of confidence.")
      .def_readonly("warnings", &Recognition::warnings,
                    "What may be wrong with the scan although it is answered.")
      .def_readonly("seconds", &Recognition::seconds)
      .def("__len__", [](const Recognition& answer) { return answer.found.size(); })
      .def("__getitem__",
           [](const Recognition& answer, py::ssize_t i) {
             const auto count = static_cast<py::ssize_t>(answer.found.size());
             if (i < -count || i >= count) throw py::index_error();
             return answer.found[static_cast<std::size_t>(i < 0 ? i + count : i)];
           })
      .def(
          "__iter__",
          [](const Recognition& answer) {
            return py::make_iterator(answer.found.begin(), answer.found.end());
          },
          py::keep_alive<0, 1>());

  py::class_<Recognizer>(module, "Recognizer",
                         "Models, prepared once, to be found in any number of scans.")
      .def(py::init([](const py::object& models, const std::string& config,
                       const std::vector<std::string>& set, const std::string& model_unit,
                       const std::string& scene_unit, const std::string& cache, std::size_t threads,
                       std::uint64_t seed) {
             const std::vector<ObjectModel> objects = to_models(models);
             const RecognizerOptions options{config, set,     model_unit, scene_unit,
                                             cache,  threads, seed};
             const py::gil_scoped_release others_run;
             return std::make_unique<Recognizer>(objects, options);
           }),
           "models"_a, py::kw_only(), "config"_a = "default", "set"_a = std::vector<std::string>{},
           "model_unit"_a = "", "scene_unit"_a = "", "cache"_a = "", "threads"_a = 0, "seed"_a = 0,
           "Trains the models, or takes them from the cache.\n\n"
           "models: of each a file's name, an n x 3 array, a mesh with vertices and faces\n"
           "  (trimesh) or triangles (Open3D), or a dict of file, points, normals, faces, name,\n"
           "  obj_id.\n"
           "config: a file, or one that comes with posevote (default, bop, uwa ...).\n"
           "set: ['node.param=value', ...] over it.\n"
           "model_unit, scene_unit: 'mm', 'cm', 'm', 'in' or 'auto'; '': as the config says.\n"
           "cache: folder of trained libraries; '': ~/.cache/posevote.\n"
           "threads: 0 for all cores.")
      .def("detect", &detect, "points"_a = py::none(), py::kw_only(), "normals"_a = py::none(),
           "sensor"_a = py::none(), "depth"_a = py::none(), "K"_a = py::none(),
           "depth_scale"_a = py::none(), "file"_a = py::none(),
           "Finds the models in one scan.\n\n"
           "points: n x 3 or h x w x 3 (rows with NaN are left out), or what has .points, as an\n"
           "  Open3D cloud; normals: as many, or None; sensor: where it stood, x y z or 4 x 4.\n"
           "depth: h x w with K, 3 x 3; depth_scale: metres a unit, by default 0.001 of uint16,\n"
           "  else 1; 0 or NaN is no measurement.\n"
           "file: a scan's name.\n\n"
           "Raises RuntimeError 'node: why' for a scan that cannot be answered. Any number of\n"
           "threads may call it.")
      .def_property_readonly("models", &Recognizer::model_names, "Their names, by obj_id.");
}

}  // namespace posevote
