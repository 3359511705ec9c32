#include "motion/motion_graph_map.h"

#include <cmath>
#include <numeric>

namespace ringcraft {

CloudMatrix cloud_matrix(const Skeleton& skeleton, const Clip& clip, std::vector<Tick> ticks) {
  constexpr auto kPoints = static_cast<Eigen::Index>(kCloudPoints);
  const auto& weight = cloud_weights();
  const float total = std::accumulate(weight.begin(), weight.end(), 0.0f);
  const auto frames = static_cast<Eigen::Index>(ticks.size());
  CloudMatrix m;
  m.ground.resize(2 * kPoints, frames);
  m.crossed.resize(2 * kPoints, frames);
  m.height.resize(kPoints, frames);
  for (Eigen::Index f = 0; f < frames; ++f) {
    const Cloud cloud = cloud_at(skeleton, clip, ticks[static_cast<std::size_t>(f)]);
    float x = 0, z = 0;
    for (std::size_t i = 0; i < kCloudPoints; ++i) {
      x += weight[i] / total * cloud.position[i].x;
      z += weight[i] / total * cloud.position[i].z;
    }
    for (std::size_t i = 0; i < kCloudPoints; ++i) {
      const float root = std::sqrt(weight[i] / total);
      const auto p = static_cast<Eigen::Index>(i);
      m.ground(p, f) = root * (cloud.position[i].x - x);
      m.ground(p + kPoints, f) = root * (cloud.position[i].z - z);
      m.crossed(p, f) = m.ground(p + kPoints, f);
      m.crossed(p + kPoints, f) = -m.ground(p, f);
      m.height(p, f) = root * cloud.position[i].y;
    }
  }
  m.square =
      m.ground.colwise().squaredNorm().transpose() + m.height.colwise().squaredNorm().transpose();
  m.ticks = std::move(ticks);
  return m;
}

Eigen::MatrixXf distances(const CloudMatrix& a, std::size_t first, std::size_t count,
                          const CloudMatrix& b) {
  const auto begin = static_cast<Eigen::Index>(first), rows = static_cast<Eigen::Index>(count);
  const auto ground = a.ground.middleCols(begin, rows).transpose();
  const Eigen::MatrixXf cosine = ground * b.ground;
  const Eigen::MatrixXf sine = ground * b.crossed;
  Eigen::MatrixXf result = a.height.middleCols(begin, rows).transpose() * b.height;
  result.array() += (cosine.array().square() + sine.array().square()).sqrt();
  result *= -2.0f;
  result.colwise() += a.square.segment(begin, rows);
  result.rowwise() += b.square.transpose();
  result = result.cwiseMax(0.0f).cwiseSqrt();
  return result;
}

DistanceMap distance_map(const Skeleton& skeleton, const Clip& rows, const Clip& columns,
                         Tick stride) {
  const auto every = [&](const Clip& clip) {
    std::vector<Tick> ticks;
    for (Tick t = 0; t <= clip.length(); t += stride) ticks.push_back(t);
    return cloud_matrix(skeleton, clip, std::move(ticks));
  };
  const CloudMatrix a = every(rows), b = every(columns);
  const Eigen::MatrixXf all = distances(a, 0, a.ticks.size(), b);
  DistanceMap map{a.ticks.size(), b.ticks.size(), {}};
  map.distance.reserve(map.rows * map.columns);
  for (Eigen::Index i = 0; i < all.rows(); ++i) {
    for (Eigen::Index j = 0; j < all.cols(); ++j) map.distance.push_back(all(i, j));
  }
  return map;
}

}  // namespace ringcraft
