// Where a capture's floor is and where its feet stand on it: see contacts_of to carry_feet in
// retarget.h.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/quantile.h"
#include "capture/retarget.h"
#include "motion/ik.h"
#include "motion/smooth.h"

namespace ringcraft {
namespace {

constexpr float kSoftShare = 0.985f;       // of a leg's length: beyond it its reach is eased
constexpr float kSlopeSigma = 0.0175f;     // slope that floors of captures have, about 1 degree
constexpr float kPlantSigma = 0.008f;      // m by which plants on one floor differ in height
constexpr float kLargestSlope = 0.0524f;   // 3 degrees
constexpr float kSwingRoom = kPlantSigma;  // m
constexpr float kLargestLift = 0.03f;      // m by which one side's height may differ from the mean

constexpr float kRestExtent = 0.012f;      // m over which a resting ball of the foot may stray
constexpr std::size_t kShortestRest = 30;  // ticks
constexpr float kSlide = 0.04f;  // m between two rests: a longer way is a slide, no contact
constexpr std::size_t kShortestSlide = 18;  // ticks: V4 sees no shorter one
constexpr float kStanding = 0.15f;  // m/s: faster is no standing (V4 counts skate from here)
constexpr float kStray = 0.025f;    // m off its rest: a foot this far has left

constexpr std::size_t at(Side side) {
  return static_cast<std::size_t>(side);
}

// The height under which a twentieth of the path lies, m.
float lowest_twentieth(const std::vector<Vec3>& path) {
  std::vector<float> heights;
  heights.reserve(path.size());
  for (const Vec3& p : path) heights.push_back(p.y);
  return quantile(std::move(heights), 0.05);
}

struct LevelPlant {
  std::size_t side;
  Vec3 place;  // median height
};

std::vector<LevelPlant> plants_of(const CapturedFeet& feet,
                                  const std::vector<FootContacts>& contacts) {
  constexpr std::size_t kShortest = 10;  // ticks
  std::vector<LevelPlant> plants;
  for (const Side side : {Side::left, Side::right}) {
    const std::vector<Vec3>& path = feet.ball[at(side)];
    for (std::size_t i = 0; i < contacts.size();) {
      Vec3 sum{};
      std::vector<float> heights;
      std::size_t end = i;
      for (; end < contacts.size() && contacts[end].of(side); ++end) {
        sum += path[end];
        heights.push_back(path[end].y);
      }
      if (end - i >= kShortest) {
        sum /= static_cast<float>(end - i);
        plants.push_back({at(side), {sum.x, median(heights), sum.z}});
      }
      i = std::max(end, i + 1);
    }
  }
  return plants;
}

// Solves a x = b for a symmetric positive definite 2 x 2 matrix.
Vec2 solved(float xx, float xz, float zz, Vec2 b) {
  const float determinant = xx * zz - xz * xz;
  return Vec2(zz * b.x - xz * b.y, xx * b.y - xz * b.x) / determinant;
}

// A foot that slides slowly for as long as a rest lasts carries all the same: it is the capture
// that slides.
void hold_slow_slides(const std::vector<bool>& near_floor, const std::vector<float>& speed,
                      float slow, std::vector<bool>& planted) {
  for (std::size_t i = 0; i < planted.size();) {
    std::size_t end = i;
    bool seen = false;
    for (; end < planted.size() && near_floor[end] && speed[end] < slow; ++end)
      seen = seen || planted[end];
    if (!seen && end - i >= kShortestRest)
      std::fill_n(planted.begin() + static_cast<std::ptrdiff_t>(i), end - i, true);
    i = std::max(end, i + 1);
  }
}

// A foot that is nowhere slower than a slide, and too briefly to be seen sliding, shuffles on.
void lift_shuffles(const std::vector<float>& speed, std::vector<bool>& planted) {
  for (std::size_t i = 0; i < planted.size();) {
    std::size_t end = i;
    bool stands = false;
    for (; end < planted.size() && planted[end]; ++end) stands = stands || speed[end] < kStanding;
    if (!stands && end - i < kShortestSlide)
      std::fill_n(planted.begin() + static_cast<std::ptrdiff_t>(i), end - i, false);
    i = std::max(end, i + 1);
  }
}

// A foot that creeps through a contact stands where it is slow; it has left where it is fast and
// far from there.
void lift_far_ends(const std::vector<Vec3>& path, const std::vector<float>& speed,
                   std::size_t begin, std::size_t end, std::vector<bool>& planted) {
  Vec3 sum{};
  float slow = 0;
  for (std::size_t k = begin; k < end; ++k)
    if (speed[k] < kStanding) sum += path[k], ++slow;
  if (slow == 0) return;
  const Vec3 place = sum / slow;
  const auto left = [&](std::size_t k) {
    return speed[k] >= kStanding && std::hypot(path[k].x - place.x, path[k].z - place.z) > kStray;
  };
  while (begin < end && left(begin)) planted[begin++] = false;
  while (end > begin && left(end - 1)) planted[--end] = false;
}

// A foot that slides from one rest to another is not planted on the way.
void lift_slides(const std::vector<Vec3>& path, const std::vector<float>& speed,
                 std::vector<bool>& planted) {
  for (std::size_t i = 0; i < planted.size();) {
    std::size_t end = i;
    while (end < planted.size() && planted[end]) ++end;
    const std::vector<Rest> rests = rests_of(path, i, end);
    if (rests.empty()) lift_far_ends(path, speed, i, end, planted);
    const auto off = [&](std::size_t k, const Rest& rest) {
      return std::hypot(path[k].x - rest.place.x, path[k].z - rest.place.z);
    };
    if (!rests.empty()) {
      for (std::size_t k = rests.front().begin; k-- > i;)
        if (off(k, rests.front()) > kStray) planted[k] = false;
      for (std::size_t k = rests.back().end; k < end; ++k)
        if (off(k, rests.back()) > kStray) planted[k] = false;
    }
    for (std::size_t r = 1; r < rests.size(); ++r) {
      const float way = std::hypot(rests[r].place.x - rests[r - 1].place.x,
                                   rests[r].place.z - rests[r - 1].place.z);
      if (way > kSlide)
        for (std::size_t k = rests[r - 1].end; k < rests[r].begin; ++k) planted[k] = false;
    }
    i = std::max(end, i + 1);
  }
}

}  // namespace

std::vector<Rest> rests_of(const std::vector<Vec3>& path, std::size_t begin, std::size_t end) {
  std::vector<Rest> rests;
  for (std::size_t i = begin; i < end;) {
    Vec3 low = path[i], high = path[i], sum{};
    std::size_t k = i;
    for (; k < end; ++k) {
      low = glm::min(low, path[k]);
      high = glm::max(high, path[k]);
      if (high.x - low.x > kRestExtent || high.z - low.z > kRestExtent) break;
      sum += path[k];
    }
    if (k - i >= kShortestRest) {
      rests.push_back({i, k, sum / static_cast<float>(k - i)});
      i = k;
    } else {
      ++i;
    }
  }
  return rests;
}

std::vector<FootContacts> contacts_of(const CapturedFeet& feet, const RetargetSettings& settings) {
  const std::size_t count = feet.hips.size();
  std::vector<FootContacts> contacts(count);
  for (const Side side : {Side::left, Side::right}) {
    const std::vector<Vec3>& path = feet.ball[at(side)];
    const float low = lowest_twentieth(path);
    std::vector<bool> planted(count), near_floor(count);
    std::vector<float> speed(count);
    bool carries = false;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t before = i >= 2 ? i - 2 : 0;
      const std::size_t after = std::min(i + 2, count - 1);
      const float elapsed =
          static_cast<float>(std::max<std::size_t>(1, after - before)) * kTickSeconds;
      speed[i] = glm::distance(path[before], path[after]) / elapsed;
      near_floor[i] = path[i].y < low + settings.contact_height;
      carries =
          near_floor[i] && speed[i] < (carries ? settings.release_speed : settings.contact_speed);
      planted[i] = carries;
    }
    const std::vector<float> calm = smoothed(speed, 0.04f);
    hold_slow_slides(near_floor, calm, settings.release_speed, planted);
    close_short_runs(planted, false, 5);
    close_short_runs(planted, true, 8);
    lift_slides(path, calm, planted);
    close_short_runs(planted, false, 9);
    close_short_runs(planted, true, 8);
    lift_shuffles(speed, planted);
    for (std::size_t i = 0; i < count; ++i)
      (side == Side::left ? contacts[i].left : contacts[i].right) = planted[i];
  }
  return contacts;
}

namespace {

// One fit: the plane under the plants that are seen as such.
Quat level_of(const CapturedFeet& feet, const std::vector<FootContacts>& contacts) {
  const std::vector<LevelPlant> plants = plants_of(feet, contacts);
  // Ridge regression of height = height of the side + slope . place, the slope's prior normal about
  // zero; Huber's weights keep a foot on a mat or on its toes from tilting the floor.
  std::vector<float> weight(plants.size(), 1.0f);
  Vec2 slope{};
  for (int round = 0; round < 5; ++round) {
    std::array<float, 2> weights{};
    std::array<Vec3, 2> mean{};
    for (std::size_t p = 0; p < plants.size(); ++p) {
      weights[plants[p].side] += weight[p];
      mean[plants[p].side] += weight[p] * plants[p].place;
    }
    for (std::size_t s = 0; s < 2; ++s)
      if (weights[s] > 0) mean[s] /= weights[s];
    const float prior = (kPlantSigma / kSlopeSigma) * (kPlantSigma / kSlopeSigma);
    float xx = prior, xz = 0, zz = prior;
    Vec2 b{};
    for (std::size_t p = 0; p < plants.size(); ++p) {
      const Vec3 off = plants[p].place - mean[plants[p].side];
      xx += weight[p] * off.x * off.x;
      xz += weight[p] * off.x * off.z;
      zz += weight[p] * off.z * off.z;
      b += weight[p] * off.y * Vec2(off.x, off.z);
    }
    slope = solved(xx, xz, zz, b);
    for (std::size_t p = 0; p < plants.size(); ++p) {
      const Vec3 off = plants[p].place - mean[plants[p].side];
      const float miss = std::abs(off.y - glm::dot(slope, Vec2(off.x, off.z)));
      weight[p] = miss <= kPlantSigma ? 1.0f : kPlantSigma / miss;
    }
  }
  const float steep = glm::length(slope);
  if (steep > kLargestSlope) slope *= kLargestSlope / steep;
  return rotation_between(Vec3(-slope.x, 1, -slope.y), kUp);
}

}  // namespace

Quat floor_level(const CapturedFeet& feet, const RetargetSettings& settings) {
  // On a tilted floor the higher plants are first taken for lifted feet.
  constexpr int kRounds = 3;
  Quat level(1, 0, 0, 0);
  for (int round = 0; round < kRounds; ++round) {
    CapturedFeet leveled = feet;
    for (auto& path : leveled.ball)
      for (Vec3& p : path) p = level * p;
    level = level_of(feet, contacts_of(leveled, settings));
  }
  return level;
}

void stand_on_floor(const Skeleton& skeleton, CapturedFeet& feet, Clip& clip) {
  std::array<std::vector<float>, 2> lifts;
  std::vector<float> both, all;
  for (std::size_t i = 0; i < clip.frames.size(); ++i) {
    const WorldPose world = world_pose(skeleton, clip.frames[i]);
    for (const Side side : {Side::left, Side::right}) {
      const Vec3 foot = skeleton.offset[index(toes(side))];
      const Vec3 ball =
          feet.ankle[at(side)][i] +
          (feet.has_toes ? world.rotation[index(leg(side).end)] * foot : Vec3(0, foot.y, 0));
      const float lift = skeleton.toe_height() - ball.y;
      all.push_back(lift);
      if (!clip.contacts[i].of(side)) continue;
      lifts[at(side)].push_back(lift);
      both.push_back(lift);
    }
  }
  // Without contacts (a clip in the air) the lowest twentieth stands for the floor.
  const float mean = both.empty() ? quantile(std::move(all), 0.95) : median(both);
  for (Pose& pose : clip.frames) pose.hips.y += mean;
  for (std::size_t s = 0; s < 2; ++s) {
    // Toward its lowest plants: the swings between the higher ones stay as free of the floor as
    // they were.
    float own = lifts[s].empty() ? mean
                                 : std::min(median(lifts[s]) + kSwingRoom,
                                            *std::max_element(lifts[s].begin(), lifts[s].end()));
    if (!feet.has_toes) own = skeleton.ankle_height() - lowest_twentieth(feet.ankle[s]);
    const float lift = std::clamp(own, mean - kLargestLift, mean + kLargestLift);
    for (Vec3& p : feet.ankle[s]) p.y += lift;
  }
}

void carry_feet(const Skeleton& skeleton, const CapturedFeet& feet, Clip& clip) {
  for (std::size_t i = 0; i < clip.frames.size(); ++i)
    for (const Side side : {Side::left, Side::right})
      move_limb_end(skeleton, leg(side), feet.ankle[at(side)][i], kSoftShare, clip.frames[i]);
}

}  // namespace ringcraft
