// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace posevote {

/// The log odds of being right are offset + weights . clues.
struct Logistic {
  double offset = 0;
  Eigen::VectorXd weights;

  double probability(const Eigen::VectorXd& clues) const;
};

/// Logistic regression by Newton's method, with a penalty on the weights of standardised clues that
/// stands for one detection (ridge; Hastie, Tibshirani, Friedman 2009, section 4.4): clues that say
/// the same share the weight. `clues`: n x k; `right`: n, 0 or 1; `importance`: n. Needs some of
/// both kinds; throws std::invalid_argument where all are right or all wrong. `known`: n log odds
/// that are added to those of the clues, or none.
Logistic fit_logistic(const Eigen::MatrixXd& clues, const Eigen::VectorXd& right,
                      const Eigen::VectorXd& importance, const Eigen::VectorXd& known = {});

}  // namespace posevote
