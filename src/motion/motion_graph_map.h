#pragma once
// Distance maps between the frames of clips, many at once. Inside the motion graph only.
//
// With weights that sum to one and clouds centred on the ground, the closed form of Kovar, Gleicher
// and Pighin leaves, for the best turn about the vertical,
//   d^2 = |a|^2 + |b|^2 - 2 (sqrt(C^2 + S^2) + Y),
//   C = sum w (ax bx + az bz), S = sum w (ax bz - az bx), Y = sum w ay by:
// three products of matrices for all pairs together.

#include <Eigen/Core>

#include "motion/motion_graph.h"

namespace ringcraft {

// Clouds of some ticks of one clip as columns, scaled by the roots of their weights.
struct CloudMatrix {
  std::vector<Tick> ticks;
  Eigen::MatrixXf ground;   // 2P x F: x, then z, centred
  Eigen::MatrixXf crossed;  // 2P x F: z, then -x
  Eigen::MatrixXf height;   // P x F
  Eigen::VectorXf square;   // |a|^2
};

CloudMatrix cloud_matrix(const Skeleton& skeleton, const Clip& clip, std::vector<Tick> ticks);

// Distances of rows [first, first + count) of `a` to all columns of `b`, m.
Eigen::MatrixXf distances(const CloudMatrix& a, std::size_t first, std::size_t count,
                          const CloudMatrix& b);

}  // namespace ringcraft
