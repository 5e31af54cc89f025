// SPDX-License-Identifier: BSD-3-Clause
#include <catch2/catch.hpp>
#include <limits>

#include "nodes/pictures/painter.hpp"
#include "tests/nodes/write/picture.hpp"
#include "tests/nodes/write/writer.hpp"
#include "tests/support/temporary_folder.hpp"

namespace posevote::write_picture_test {

using posevote::test::make_detection;
using posevote::test::make_library;
using posevote::test::make_patch;
using posevote::test::Picture;
using posevote::test::run_writer;
using posevote::test::TemporaryFolder;

namespace {

Picture draw(const Cloud& scan, const Detections& detections) {
  const TemporaryFolder folder;
  run_writer("write_picture", "1", {0, "shelf", folder.path(), 0}, scan, detections,
             make_library());
  return Picture(folder / "pictures/shelf.png");
}

bool is_red(const formats::Rgb& pixel) {
  return pixel[0] > 2 * pixel[1] && pixel[0] > 2 * pixel[2];
}
bool is_grey(const formats::Rgb& pixel) {
  return std::abs(pixel[0] - pixel[2]) < 8 && pixel[0] < 220;
}

/// Mean place of the pixels that fulfil `test`, in parts of the width, and their number.
template <class Test>
Eigen::Vector3d middle_of(const Picture& picture, const Test& test) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      if (test(picture.at(x, y))) sum += Eigen::Vector3d(x, y, 1);
  return {sum.x() / sum.z() / picture.width, sum.y() / sum.z() / picture.width, sum.z()};
}

/// A wall of 40 cm at 1 m, finer in one direction than in the other, as many scans are.
Cloud wall() {
  Cloud scan = make_patch(101, 0.004F, 1);
  for (Eigen::Index i = 0; i < scan.points.rows(); ++i)
    scan.points(i, 2) += 1e-4F * static_cast<float>(i % 7);
  return scan;
}

}  // namespace

TEST_CASE("write_picture shows a scan's colours, and outlines of what was found",
          "[write][color]") {
  Cloud scan = wall();
  scan.colors = ColorMatrix::Zero(scan.points.rows(), 3);
  scan.colors.col(2).setOnes();
  const Picture picture = draw(scan, {{make_detection({0.1, -0.05, 0.99})}});
  const auto is_blue = [](const formats::Rgb& pixel) { return pixel[2] > 250 && pixel[0] < 5; };
  const double blue = middle_of(picture, is_blue).z();
  CHECK(blue > 0.8 * picture.width * picture.height);
  const Eigen::Vector3d red = middle_of(picture, is_red);
  CHECK(red.x() == Approx(0.5 + 0.1 / 0.99 / (0.4 * 1.06)).margin(0.01));
  const double filled = middle_of(draw(wall(), {{make_detection({0.1, -0.05, 0.99})}}), is_red).z();
  CHECK(red.z() < 0.5 * filled);
}

TEST_CASE("write_picture shows the scan whole and the model where it was found", "[write]") {
  const Picture picture = draw(wall(), {{make_detection({0.1, -0.05, 0.99})}});
  CHECK(picture.width == 1280);
  CHECK(picture.height == Approx(1280).margin(3));
  const Eigen::Vector3d red = middle_of(picture, is_red);
  // The wall and a margin of 3 % on either side fill the picture; the model is 1 % nearer.
  CHECK(red.x() == Approx(0.5 + 0.1 / 0.99 / (0.4 * 1.06)).margin(0.01));
  CHECK(red.y() == Approx(0.5 - 0.05 / 0.99 / (0.4 * 1.06)).margin(0.01));
  const double side = 0.062 / 0.99 / (0.4 * 1.06) * 1280;
  CHECK(red.z() > 0.75 * side * side);  // its label covers some of it
  CHECK(red.z() < 1.1 * side * side);
  int holes = 0;
  for (int y = 60; y < picture.height - 60; ++y)
    for (int x = 60; x < picture.width - 60; ++x) holes += picture.at(x, y)[0] > 240;
  CHECK(holes == 0);
}

TEST_CASE("write_picture: a model on the surface is seen, one behind it is not", "[write]") {
  CHECK(middle_of(draw(wall(), {{make_detection({0, 0, 1.0})}}), is_red).z() > 10000);
  // Only its label's letters are red.
  CHECK(middle_of(draw(wall(), {{make_detection({0, 0, 1.05})}}), is_red).z() < 2000);
  Detection turned = make_detection({0, 0, 0.9});  // its back to the sensor
  turned.T_scene_model.linear() = Eigen::Vector3d(-1, 1, -1).asDiagonal();
  CHECK(middle_of(draw(wall(), {{turned}}), is_red).z() < 2000);
}

TEST_CASE("the picture is upright for cameras that look along +z and along -z", "[write]") {
  for (const float look : {1.0F, -1.0F}) {
    Cloud scan = wall();
    scan.points.rightCols(2) *= look;  // y down and z forward; or y up and z back
    const pictures::Perspective view = pictures::perspective_of(scan, {}, 100);
    const Eigen::Vector3f up_right(0.1F, -0.1F * look, look);
    const Eigen::Vector2f at = view.in_picture(view.in_view(up_right));
    CHECK(at.x() > 60);
    CHECK(at.y() < 40);
    CHECK(view.in_view(up_right).z() > 0);
    CHECK(view.axes.determinant() == Approx(1));
  }
}

TEST_CASE("a scan far from its frame's origin is seen as from there", "[write]") {
  const Cloud scan = wall();
  Cloud far = scan;
  const Eigen::RowVector3f away(300, -200, 100);
  far.points.rowwise() += away;
  far.view.origin = away.transpose();
  const pictures::Perspective here = pictures::perspective_of(scan, {}, 100);
  const pictures::Perspective there = pictures::perspective_of(far, {}, 100);
  CHECK(there.eye == far.view.origin);
  CHECK(there.axes.isApprox(here.axes, 1e-4F));
  CHECK(there.scale == Approx(here.scale).epsilon(0.02));  // by a row more or less
  for (Eigen::Index i = 0; i < scan.points.rows(); i += 100) {
    const Eigen::Vector2f a = here.in_picture(here.in_view(scan.points.row(i)));
    const Eigen::Vector2f b = there.in_picture(there.in_view(far.points.row(i)));
    CHECK((a - b).norm() < 1.5F);
  }
}

TEST_CASE("what reaches beyond the scan is in the picture, too", "[write]") {
  const Cloud scan = wall();
  PointMatrix also(1, 3);
  also << 2, 0, 1;
  const pictures::Perspective view = pictures::perspective_of(scan, also, 100);
  const Eigen::Vector2f at = view.in_picture(view.in_view(also.row(0)));
  CHECK(at.x() > 90);
  CHECK(at.x() < 100);
}

TEST_CASE("outliers do not shrink the scan, nor is a slender one cut", "[write]") {
  Cloud scan = wall();
  const float scale = pictures::perspective_of(scan, {}, 100).scale;
  scan.points.row(0) << 50, 3, 1;
  CHECK(pictures::perspective_of(scan, {}, 100).scale > 0.75F * scale);
  Cloud tall = make_patch(101, 0.004F, 1);
  tall.points.col(0) *= 0.1F;
  const pictures::Perspective view = pictures::perspective_of(tall, {}, 100);
  CHECK(view.height == 150);
  for (const Eigen::Index corner : {Eigen::Index{0}, tall.points.rows() - 1}) {
    const Eigen::Vector2f at = view.in_picture(view.in_view(tall.points.row(corner)));
    CHECK((at.array() >= 0).all());
    CHECK(at.x() <= 100);
    CHECK(at.y() <= 150);
  }
}

TEST_CASE("spacing is that of the points, not of what was expected", "[write]") {
  CHECK(pictures::spacing_of(make_patch(50, 0.004F, 1).points, 0.002F) == Approx(0.004));
  CHECK(pictures::spacing_of(make_patch(50, 0.001F, 1).points, 0.002F) == Approx(0.001));
  CHECK(pictures::spacing_of(PointMatrix(0, 3), 0.002F) == 0.002F);
  CHECK(pictures::spacing_of(make_patch(3, 1, 1).points, 0) > 0);
}

TEST_CASE("labels of instances at one place do not cover each other", "[write]") {
  const auto is_letter = [](const formats::Rgb& p) { return p[0] > p[1] + 60 && p[0] > p[2] + 60; };
  const auto letters = [&](const Detections& detections) {
    return middle_of(draw(wall(), detections), is_letter).z();
  };
  // Behind the wall: nothing but labels. The first keeps every dot when a second one joins it.
  const Detection behind = make_detection({0, 0, 1.2});
  CHECK(letters({{behind}}) > 300);
  CHECK(letters({{behind, behind}}) == letters({{behind}}));
}

TEST_CASE("discs lie in the surface: what is just in front of a slope is seen", "[write]") {
  const auto slope = [](int side, float step, float depth, float steep) {
    Cloud cloud = make_patch(side, step, depth);
    cloud.points.col(2) += steep * cloud.points.col(0);
    const Eigen::Vector3f normal = Eigen::Vector3f(steep, 0, -1).normalized();
    cloud.normals.rowwise() = normal.transpose();
    return cloud;
  };
  const TemporaryFolder folder;
  for (const float steep : {-1.0F, 1.0F}) {
    const Cloud coarse = slope(11, 0.04F, 1, steep);
    pictures::Painter painter(coarse, {}, 300, 0.04F);
    painter.draw(coarse, Eigen::Isometry3f::Identity(), pictures::Colour(0, 1, 0), 0);
    painter.draw(slope(101, 0.003F, 0.998F, steep), Eigen::Isometry3f::Identity(),
                 pictures::Colour(1, 0, 0), 0);
    painter.save(folder / "a.png");
    const Picture picture(folder / "a.png");
    int green = 0;  // in the middle, where red is in front
    for (int y = 110; y < 190; ++y)
      for (int x = 110; x < 190; ++x) green += picture.at(x, y)[1] > picture.at(x, y)[0];
    CHECK(green == 0);
  }
}

TEST_CASE("write_picture takes what is empty, not finite or without normals", "[write]") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  Detections odd{{make_detection({0, 0, 1}), make_detection({kNan, 0, 1}),
                  make_detection({1e30, -1e30, 1}), make_detection({0, 0, -1}),
                  make_detection({0, 0, 0})}};
  odd.items.push_back(make_detection({0, 0, 1}));
  odd.items.back().obj_id = 9;
  odd.items[0].model = std::string(500, 'x');
  Cloud bare = wall();
  bare.normals.resize(0, 3);
  CHECK(middle_of(draw(bare, {}), is_grey).z() > 1e6);
  Cloud damaged = wall();
  damaged.points.row(5).setConstant(std::numeric_limits<float>::quiet_NaN());
  damaged.normals.topRows(50).setZero();
  Cloud one_point = make_patch(1, 1, 1), at_sensor = make_patch(1, 1, 0);
  for (const Cloud& scan : {Cloud(), bare, damaged, one_point, at_sensor})
    CHECK(draw(scan, odd).width == 1280);
}

TEST_CASE("write_picture writes nothing without an output folder, and says where it cannot",
          "[write]") {
  const TemporaryFolder folder;
  CHECK_NOTHROW(run_writer("write_picture", "1", {}, wall(), Detections(), make_library()));
  run_writer("write_picture", "0", {}, wall(), Detections(), make_library());
  folder.write("pictures", "a file where the folder should be");
  CHECK_THROWS_WITH(run_writer("write_picture", "1", {0, "shelf", folder.path(), 0}, wall(),
                               Detections(), make_library()),
                    Catch::Contains("pictures"));
}

}  // namespace posevote::write_picture_test
