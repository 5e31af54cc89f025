// SPDX-License-Identifier: BSD-3-Clause
#include "tools/calibrate/logistic.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <stdexcept>

namespace posevote {
namespace {

constexpr int kMostSteps = 100;
constexpr double kStill = 1e-9, kPenalty = 1;

Eigen::VectorXd sigmoid(const Eigen::VectorXd& log_odds) {
  return (1 + (-log_odds.array()).exp()).inverse().matrix();
}

/// Clues of mean 0 and deviation 1, behind a column of ones.
struct Standardised {
  Eigen::RowVectorXd mean, deviation;
  Eigen::MatrixXd columns;
};

Standardised standardise(const Eigen::MatrixXd& clues) {
  Standardised out;
  out.mean = clues.colwise().mean();
  const Eigen::MatrixXd centred = clues.rowwise() - out.mean;
  out.deviation = centred.colwise().squaredNorm().cwiseSqrt() / std::sqrt(double(clues.rows()));
  out.deviation = (out.deviation.array() > 1e-9).select(out.deviation, 1);  // one that never varies
  out.columns.resize(clues.rows(), clues.cols() + 1);
  out.columns.col(0).setOnes();
  out.columns.rightCols(clues.cols()) = centred.array().rowwise() / out.deviation.array();
  return out;
}

}  // namespace

double Logistic::probability(const Eigen::VectorXd& clues) const {
  return 1 / (1 + std::exp(-(offset + weights.dot(clues))));
}

Logistic fit_logistic(const Eigen::MatrixXd& clues, const Eigen::VectorXd& right,
                      const Eigen::VectorXd& importance, const Eigen::VectorXd& known) {
  if (right.size() == 0 || right.maxCoeff() < 1 || right.minCoeff() > 0)
    throw std::invalid_argument("expected detections that are right and some that are wrong");
  const Standardised x = standardise(clues);
  const Eigen::VectorXd base = known.size() > 0 ? known : Eigen::VectorXd::Zero(right.size());
  Eigen::VectorXd penalty = Eigen::VectorXd::Constant(x.columns.cols(), kPenalty);
  penalty[0] = 1e-9;  // the offset is free
  Eigen::VectorXd beta = Eigen::VectorXd::Zero(x.columns.cols());
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::VectorXd p = sigmoid(base + x.columns * beta);
    const Eigen::VectorXd spread = (importance.array() * p.array() * (1 - p.array())).matrix();
    Eigen::MatrixXd hessian = x.columns.transpose() * spread.asDiagonal() * x.columns;
    hessian.diagonal() += penalty;
    const Eigen::VectorXd gradient =
        x.columns.transpose() * (importance.array() * (right - p).array()).matrix() -
        penalty.cwiseProduct(beta);
    const Eigen::VectorXd change = hessian.ldlt().solve(gradient);
    beta += change;
    if (change.cwiseAbs().maxCoeff() < kStill) break;
  }
  Logistic fitted;
  fitted.weights = beta.tail(clues.cols()).cwiseQuotient(x.deviation.transpose());
  fitted.offset = beta[0] - fitted.weights.dot(x.mean.transpose());
  return fitted;
}

}  // namespace posevote
