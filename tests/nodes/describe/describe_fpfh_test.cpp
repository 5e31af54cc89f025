// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/features/fpfh.h>
#include <pcl/search/kdtree.h>

#include <catch2/catch.hpp>

#include "nodes/adapters/pcl_surface.hpp"
#include "tests/nodes/describe/described_body.hpp"

namespace posevote::describe_fpfh_test {

using namespace posevote::test;

namespace {

const std::string kNode = "describe_fpfh";

}  // namespace

TEST_CASE("FPFH equals PCL's own class", "[describe]") {
  const Cloud body = bumpy_cloud(2, kResolution);
  const FeatureSet ours = described(kNode, body, 1, {{"radius", "4"}});
  const adapters::PclSurface surface = adapters::make_pcl_surface(body);
  pcl::FPFHEstimation<pcl::PointXYZ, pcl::Normal, pcl::FPFHSignature33> estimation;
  estimation.setInputCloud(surface.points);
  estimation.setInputNormals(surface.normals);
  estimation.setRadiusSearch(4.0 * static_cast<double>(kResolution));
  pcl::PointCloud<pcl::FPFHSignature33> theirs;
  estimation.compute(theirs);
  REQUIRE(static_cast<Eigen::Index>(theirs.size()) == ours.descriptors.rows());
  int different = 0;  // the order of summation differs, and a neighbour may lie on the edge
  for (Eigen::Index i = 0; i < ours.descriptors.rows(); ++i) {
    const Eigen::Map<const Eigen::RowVectorXf> row(theirs[static_cast<std::size_t>(i)].histogram,
                                                   33);
    different += (row - ours.descriptors.row(i)).norm() > 0.05F;
  }
  CHECK(different <= ours.descriptors.rows() / 100);
}

}  // namespace posevote::describe_fpfh_test
