// SPDX-License-Identifier: BSD-3-Clause
// What the page of `posevote view` holds of scans and models: few points, few bytes, the same shape.
#include <catch2/catch.hpp>
#include <set>

#include "tests/support/temporary_folder.hpp"
#include "tools/manifest/manifest.hpp"
#include "tools/report/model_list.hpp"
#include "tools/report/pack.hpp"
#include "tools/report/run_data.hpp"

namespace posevote::report_pack_test {

using namespace posevote::page;

namespace {

/// A square of n x n points with faces, edge 1 m, a little above the x-y plane.
Mesh square(int n) {
  Mesh mesh;
  mesh.points.resize(n * n, 3);
  for (int i = 0; i < n * n; ++i)
    mesh.points.row(i) << static_cast<float>(i % n) / float(n - 1),
        static_cast<float>(i / n) / float(n - 1), 0.5F;
  mesh.faces.resize(2 * (n - 1) * (n - 1), 3);
  for (int i = 0, f = 0; i < n * n; ++i) {
    if (i % n == n - 1 || i / n == n - 1) continue;
    const auto a = static_cast<std::uint32_t>(i), up = a + static_cast<std::uint32_t>(n);
    mesh.faces.row(f++) << a, a + 1, up;
    mesh.faces.row(f++) << a + 1, up + 1, up;
  }
  return mesh;
}

std::uint32_t number_at(const std::string& bytes, std::size_t i) {
  return static_cast<unsigned char>(bytes[2 * i]) |
         static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[2 * i + 1])) << 8U;
}

}  // namespace

TEST_CASE("packed points come back within half a step", "[report]") {
  PointMatrix points(3, 3);
  points << -1, 2, 3, 0, 2.5F, 3.25F, 1, 2, 3;
  const Packed packed = pack_points(points, {7, 8, 255});
  CHECK(packed.points == 3);
  CHECK(packed.bytes.size() == 3 * 7);
  for (std::size_t i = 0; i < 9; ++i) {
    const auto axis = static_cast<Eigen::Index>(i % 3);
    const float place =
        packed.corner(axis) + packed.step * static_cast<float>(number_at(packed.bytes, i));
    CHECK(place == Approx(points(Eigen::Index(i / 3), axis)).margin(0.51 * double(packed.step)));
  }
  CHECK(packed.bytes.substr(18) == "\x07\x08\xff");
  CHECK_THROWS_AS(pack_points(points, {1}), std::invalid_argument);
  CHECK(pack_points(PointMatrix(0, 3), {}).bytes.empty());
  CHECK_THROWS_AS(pack_mesh(PointMatrix::Zero(65537, 3), FaceMatrix(0, 3)), std::invalid_argument);
}

TEST_CASE("thinned points are as many as asked for, and even", "[report]") {
  PointMatrix points = square(200).points;
  points(7, 1) = std::numeric_limits<float>::quiet_NaN();
  const Thinned thinned = thin(points, 1000);
  CHECK(thinned.rows.size() <= 1000);
  CHECK(thinned.rows.size() > 800);
  CHECK(std::is_sorted(thinned.rows.begin(), thinned.rows.end()));
  CHECK(std::set<std::uint32_t>(thinned.rows.begin(), thinned.rows.end()).size() ==
        thinned.rows.size());
  std::set<std::pair<int, int>> tenths;
  for (const std::uint32_t row : thinned.rows) {
    CHECK(points.row(row).allFinite());
    tenths.emplace(static_cast<int>(9.99F * points(row, 0)),
                   static_cast<int>(9.99F * points(row, 1)));
  }
  CHECK(tenths.size() == 100);  // no corner is left empty
  CHECK(thin(points, 1'000'000).rows.size() == 200 * 200 - 1);
  CHECK(thin(PointMatrix::Zero(50, 3), 10).rows.size() == 10);
  CHECK(thin(PointMatrix(0, 3), 10).rows.empty());
  CHECK(thin(points, 0).rows.empty());
}

TEST_CASE("a simplified mesh has few faces and the same extent", "[report]") {
  const Mesh simple = simplify(square(100), 500);
  CHECK(simple.faces.rows() <= 500);
  CHECK(simple.faces.rows() > 100);
  CHECK(simple.faces.maxCoeff() < simple.points.rows());
  CHECK(simple.points.col(0).maxCoeff() - simple.points.col(0).minCoeff() > 0.9F);
  CHECK(simplify(square(10), 1000).faces.rows() == 162);  // as it is
  const Mesh cloud = simplify({square(100).points, PointMatrix(0, 3), {}}, 500);
  CHECK(cloud.faces.rows() == 0);
  CHECK(cloud.points.rows() <= 500);
  CHECK(cloud.points.rows() > 300);
}

TEST_CASE("a surface that faces the light is bright, one along it dark", "[report]") {
  Scan scan;
  scan.points = square(60).points;
  const Thinned thinned = thin(scan.points, 800);
  const auto middle = [&](const Eigen::Vector3f& light) {
    std::vector<std::uint8_t> bright = shade(scan, thinned, light);
    std::sort(bright.begin(), bright.end());
    return static_cast<int>(bright[bright.size() / 2]);
  };
  // The sensor stands at the origin, below the square.
  CHECK(middle({0, 0, -1}) == 255);
  CHECK(middle({1, 0, 0}) == 0);
  scan.normals = PointMatrix::Zero(scan.points.rows(), 3);
  scan.normals.col(0).setOnes();  // the file's own come first
  CHECK(middle({1, 0, 0}) + middle({-1, 0, 0}) == 255);
}

TEST_CASE("no text can leave the script that it stands in", "[report]") {
  const std::string odd = "</script><!--&\x01\xff\xe2\x80\xa8\"";
  const std::string text = script_json({{"name", odd}});
  CHECK(text.find_first_of("<>&") == std::string::npos);
  CHECK(std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c < 127; }));
  CHECK(nlohmann::json::parse(text)["name"] == "</script><!--&\x01\xef\xbf\xbd\xe2\x80\xa8\"");
}

TEST_CASE("models are those sought, those left out, and others by name", "[report]") {
  ModelList models({{3, "chef", "chef.ply", ""}, {7, "cup", "", ""}},
                   {{"torn", 9, "load_models: torn"}});
  CHECK(models.number_of(7, "cup") == 1);
  CHECK(models.number_of(0, "chef") == 0);
  CHECK(models.number_of(0, "stranger") == 3);
  CHECK(models.number_of(5, "") == 4);
  CHECK(models.to_json()[4]["name"] == "object 5");
  CHECK(models.to_json()[2]["left_out"] == "load_models: torn");
  CHECK(models.obj_id_of("cup") == 7);
  CHECK(models.obj_id_of("3") == 3);
  CHECK_THROWS_WITH(models.obj_id_of("mug"),
                    Catch::Contains("--votes mug") && Catch::Contains("chef, cup"));
  const std::string blobs = models.show({{7, square(100)}}, 400, "x");
  CHECK(blobs.starts_with("<script type=\"text/plain\" id=\"x-model1\">"));
  CHECK(models.to_json()[1]["surface"]["true_faces"] == 2 * 99 * 99);
  CHECK(models.to_json()[1]["surface"]["faces"].get<int>() <= 400);
  CHECK_FALSE(models.to_json()[0].contains("surface"));
}

TEST_CASE("a command line can be pasted into a shell", "[report]") {
  CHECK(shell_line({"posevote", "run", "a b", "it's", "", "x.y=[1]"}) ==
        "posevote run 'a b' 'it'\\''s' '' 'x.y=[1]'");
}

TEST_CASE("what a scan does not tell apart is said of a detection", "[report]") {
  ReportedObject found;
  CHECK(page::sentences(found).empty());
  Eigen::Matrix4d half = Eigen::Matrix4d::Identity();
  half(0, 0) = half(1, 1) = -1;
  found.look_alikes = {{half, 0.31}, {half, 0.2}, {half, 0.1}, {half, 0.05}};
  REQUIRE(page::sentences(found).size() == 1);
  CHECK_THAT(page::sentences(found)[0],
             Catch::Contains("a turn of 180 deg about (0 0 1) (31 %); a turn") &&
                 Catch::EndsWith("(10 %); and 1 more."));
}

}  // namespace posevote::report_pack_test
