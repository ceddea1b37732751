// SPDX-License-Identifier: Apache-2.0
#include "core/discrepancy/measurement_design.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/error.h"
#include "core/base/random.h"

namespace spindrift {
namespace {

using Eigen::Index;

/// Inverse of a covariance over the times, free of a constant.
Eigen::MatrixXd withoutConstant(const Eigen::MatrixXd& covariance) {
  const Index n = covariance.rows();
  const Eigen::LLT<Eigen::MatrixXd> llt(covariance);
  Eigen::MatrixXd inverse = llt.solve(Eigen::MatrixXd::Identity(n, n));
  const Eigen::VectorXd sum = inverse.rowwise().sum();
  inverse.noalias() -= sum * sum.transpose() / sum.sum();
  return inverse;
}

double logDeterminant(const Eigen::LLT<Eigen::MatrixXd>& llt) {
  return 2.0 * llt.matrixLLT().diagonal().array().log().sum();
}

Eigen::MatrixXd onePlus(const Eigen::MatrixXd& s) {
  Eigen::MatrixXd out = s;
  out.diagonal().array() += 1.0;
  return out;
}

}  // namespace

MeasurementDesign::MeasurementDesign(std::vector<DesignCandidate> candidates, std::vector<double> times_s,
                                     std::vector<DesignNoise> noise,
                                     std::vector<std::vector<Eigen::MatrixXd>> predicted)
    : candidates_(std::move(candidates)),
      times_s_(std::move(times_s)),
      noise_(std::move(noise)),
      predicted_(std::move(predicted)) {
  SPINDRIFT_ASSERT(noise_.size() == predicted_.size(), "noise for every component");
  for (const DesignCandidate& c : candidates_) columns_ = std::max(columns_, c.first + c.free + 1);
}

Eigen::MatrixXd MeasurementDesign::gram(const std::vector<std::size_t>& places,
                                        const std::vector<std::size_t>& times) const {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(columns_, columns_);
  const auto n = static_cast<Index>(times.size());
  if (n < 2 || places.empty()) return out;
  const double count = static_cast<double>(places.size());
  for (std::size_t c = 0; c < predicted_.size(); ++c) {
    const DesignNoise& noise = noise_[c];
    // Differences between points do not see the shift of a state; their mean sees it together with its own noise.
    Eigen::MatrixXd own = Eigen::MatrixXd::Zero(n, n);
    for (Index i = 0; i < n; ++i) {
      const std::size_t a = times[static_cast<std::size_t>(i)];
      for (Index j = 0; j <= i; ++j) {
        const std::size_t b = times[static_cast<std::size_t>(j)];
        double value = 0.0;
        if (noise.correlated_part > 0.0 && noise.correlation_time_s > 0.0) {
          value = noise.correlated_part * std::exp(-std::abs(times_s_[a] - times_s_[b]) / noise.correlation_time_s);
        }
        if (i == j) value = 1.0;
        value *= noise.own * noise.own;
        if (noise.misfit.size() > 0) {
          value += noise.misfit.row(static_cast<Index>(a)).dot(noise.misfit.row(static_cast<Index>(b)));
        }
        own(i, j) = own(j, i) = value;
      }
    }
    Eigen::MatrixXd together = own;
    together.diagonal().array() += count * noise.common * noise.common;
    const Eigen::MatrixXd by_points = withoutConstant(own);
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n, columns_);
    Eigen::MatrixXd rows(n, columns_);
    for (const std::size_t place : places) {
      const Eigen::MatrixXd& all = predicted_[c][place];
      if (all.size() == 0) continue;
      for (Index i = 0; i < n; ++i) rows.row(i) = all.row(static_cast<Index>(times[static_cast<std::size_t>(i)]));
      sum += rows;
      out.noalias() += rows.transpose() * (by_points * rows);
    }
    if (noise.common > 0.0) {
      const Eigen::MatrixXd change = withoutConstant(together) - by_points;
      out.noalias() += sum.transpose() * (change * sum) / count;
    }
  }
  return 0.5 * (out + out.transpose());
}

double MeasurementDesign::entropy() const {
  std::map<int, double> groups;
  for (const DesignCandidate& c : candidates_) groups[c.group] += c.probability;
  double sum = 0.0;
  for (const auto& [group, p] : groups) sum -= p > 0.0 ? p * std::log(p) : 0.0;
  return sum;
}

double MeasurementDesign::remainingEntropy(const Eigen::MatrixXd& gram) const {
  const std::size_t k = candidates_.size();
  std::vector<double> log_det(k);
  for (std::size_t i = 0; i < k; ++i) {
    const DesignCandidate& c = candidates_[i];
    log_det[i] = logDeterminant(Eigen::LLT<Eigen::MatrixXd>(onePlus(gram.block(c.first, c.first, c.free, c.free))));
  }
  Eigen::MatrixXd alike = Eigen::MatrixXd::Identity(static_cast<Index>(k), static_cast<Index>(k));
  for (std::size_t i = 0; i < k; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const DesignCandidate& a = candidates_[i];
      const DesignCandidate& b = candidates_[j];
      const Index ma = a.first + a.free;
      const Index mb = b.first + b.free;
      Eigen::MatrixXd middle(a.free + b.free, a.free + b.free);
      middle.topLeftCorner(a.free, a.free) = gram.block(a.first, a.first, a.free, a.free);
      middle.bottomRightCorner(b.free, b.free) = gram.block(b.first, b.first, b.free, b.free);
      middle.topRightCorner(a.free, b.free) = gram.block(a.first, b.first, a.free, b.free);
      middle.bottomLeftCorner(b.free, a.free) = middle.topRightCorner(a.free, b.free).transpose();
      Eigen::VectorXd pull(a.free + b.free);
      pull.head(a.free) = gram.block(a.first, ma, a.free, 1) - gram.block(a.first, mb, a.free, 1);
      pull.tail(b.free) = gram.block(b.first, ma, b.free, 1) - gram.block(b.first, mb, b.free, 1);
      const Eigen::LLT<Eigen::MatrixXd> llt(onePlus(0.5 * middle));
      const double distance = gram(ma, ma) + gram(mb, mb) - 2.0 * gram(ma, mb) - 0.5 * pull.dot(llt.solve(pull));
      const double b_ij = std::max(0.0, distance) / 8.0 + 0.5 * (logDeterminant(llt) - 0.5 * (log_det[i] + log_det[j]));
      const double value = std::exp(-std::max(0.0, b_ij));
      alike(static_cast<Index>(i), static_cast<Index>(j)) = value;
      alike(static_cast<Index>(j), static_cast<Index>(i)) = value;
    }
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < k; ++i) {
    double own = 0.0;
    double others = 0.0;
    for (std::size_t j = 0; j < k; ++j) {
      const double weight = candidates_[j].probability * alike(static_cast<Index>(i), static_cast<Index>(j));
      (candidates_[j].group == candidates_[i].group ? own : others) += weight;
    }
    if (candidates_[i].probability > 0.0) sum += candidates_[i].probability * std::log1p(others / own);
  }
  return sum;
}

double MeasurementDesign::expectedEvidence(const Eigen::MatrixXd& gram, std::size_t right, std::size_t wrong) const {
  const DesignCandidate& a = candidates_[right];
  const DesignCandidate& b = candidates_[wrong];
  const Index ma = a.first + a.free;
  const Index mb = b.first + b.free;
  const Eigen::MatrixXd sa = gram.block(a.first, a.first, a.free, a.free);
  const Eigen::MatrixXd sb = gram.block(b.first, b.first, b.free, b.free);
  const Eigen::MatrixXd ba = gram.block(b.first, a.first, b.free, a.free);
  const Eigen::LLT<Eigen::MatrixXd> la(onePlus(sa));
  const Eigen::LLT<Eigen::MatrixXd> lb(onePlus(sb));
  const Eigen::VectorXd pull = gram.block(b.first, ma, b.free, 1) - gram.block(b.first, mb, b.free, 1);
  const double distance = gram(ma, ma) + gram(mb, mb) - 2.0 * gram(ma, mb) - pull.dot(lb.solve(pull));
  const double trace = sa.trace() - lb.solve(sb).trace() - lb.solve(ba * ba.transpose()).trace();
  return std::max(0.0, distance + trace + logDeterminant(lb) - logDeterminant(la));
}

double MeasurementDesign::probabilityAlone(const Eigen::MatrixXd& gram, double least_rival, int draws,
                                           std::uint64_t seed) const {
  const std::size_t k = candidates_.size();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(gram);
  const Eigen::MatrixXd root = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  std::vector<Eigen::LLT<Eigen::MatrixXd>> llt;
  std::vector<double> log_det;
  for (const DesignCandidate& c : candidates_) {
    llt.emplace_back(onePlus(gram.block(c.first, c.first, c.free, c.free)));
    log_det.push_back(logDeterminant(llt.back()));
  }
  Random random(seed);
  int alone = 0;
  std::vector<double> log_p(k);
  for (int d = 0; d < draws; ++d) {
    // As many draws of every candidate as its probability asks for.
    double u = (static_cast<double>(d) + 0.5) / draws;
    std::size_t truth = 0;
    while (truth + 1 < k && u > candidates_[truth].probability) u -= candidates_[truth++].probability;
    Eigen::VectorXd made = Eigen::VectorXd::Zero(columns_);
    const DesignCandidate& t = candidates_[truth];
    made[t.first + t.free] = 1.0;
    for (Index i = 0; i < t.free; ++i) made[t.first + i] = random.normal();
    Eigen::VectorXd noise(columns_);
    for (Index i = 0; i < columns_; ++i) noise[i] = random.normal();
    const Eigen::VectorXd seen = gram * made + root * noise;  // columns' y
    double highest = -1e300;
    for (std::size_t i = 0; i < k; ++i) {
      const DesignCandidate& c = candidates_[i];
      const Index m = c.first + c.free;
      const Eigen::VectorXd pull = seen.segment(c.first, c.free) - gram.block(c.first, m, c.free, 1);
      const double left = gram(m, m) - 2.0 * seen[m] - pull.dot(llt[i].solve(pull));
      log_p[i] = std::log(std::max(1e-300, c.probability)) - 0.5 * (left + log_det[i]);
      highest = std::max(highest, log_p[i]);
    }
    std::map<int, double> groups;
    for (std::size_t i = 0; i < k; ++i) groups[candidates_[i].group] += std::exp(log_p[i] - highest);
    const double own = groups[t.group];
    alone += std::all_of(groups.begin(), groups.end(),
                         [&](const auto& g) { return g.first == t.group || g.second < least_rival * own; })
                 ? 1
                 : 0;
  }
  return static_cast<double>(alone) / draws;
}

}  // namespace spindrift
