#include "capture/sheet_track.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ringcraft {

void Track::add(float t, Vec3 value) {
  slope_.clear();
  if (!t_.empty() && t - t_.back() < 1e-4f) {
    v_.back() = value;
    return;
  }
  t_.push_back(t);
  v_.push_back(value);
}

void Track::fit() const {
  const std::size_t n = t_.size();
  slope_.assign(n, Vec3(0));
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const float h0 = t_[i] - t_[i - 1], h1 = t_[i + 1] - t_[i];
    const Vec3 d0 = (v_[i] - v_[i - 1]) / h0, d1 = (v_[i + 1] - v_[i]) / h1;
    for (int c = 0; c < 3; ++c) {
      if (d0[c] * d1[c] <= 0) continue;  // an extremum: flat
      const float w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
      slope_[i][c] = (w0 + w1) / (w0 / d0[c] + w1 / d1[c]);
    }
  }
}

Vec3 Track::at(float t) const {
  if (t_.empty()) return {};
  if (t <= t_.front()) return v_.front();
  if (t >= t_.back()) return v_.back();
  if (slope_.empty()) fit();
  const auto after = std::upper_bound(t_.begin(), t_.end(), t);
  const auto i = static_cast<std::size_t>(after - t_.begin()) - 1;
  const float h = t_[i + 1] - t_[i];
  const float u = (t - t_[i]) / h, u2 = u * u, u3 = u2 * u;
  return v_[i] * (2 * u3 - 3 * u2 + 1) + slope_[i] * (h * (u3 - 2 * u2 + u)) +
         v_[i + 1] * (3 * u2 - 2 * u3) + slope_[i + 1] * (h * (u3 - u2));
}

const std::vector<float>* speed_profile(std::string_view name) {
  static const std::vector<float> kCross = {.11f, .20f, .34f, .52f, .72f, .88f,
                                            1.0f, .92f, .68f, .39f, .29f};
  static const std::vector<float> kLongCross = {.11f, .19f, .32f, .46f, .59f, .75f,
                                                .89f, .99f, .91f, .67f, .47f};
  static const std::vector<float> kJab = {.14f, .23f, .37f, .51f, .66f, .78f,
                                          .90f, .99f, .91f, .54f, .26f};
  static const std::vector<float> kBody = {.29f, .41f, .55f, .68f, .80f, .94f,
                                           1.0f, .92f, .75f, .53f, .34f};
  // Chamber to contact of snap and swing kicks: peak 0.07 s before contact of 0.13-0.21 s.
  static const std::vector<float> kKick = {.30f, .38f, .50f, .64f, .79f, .92f,
                                           1.0f, .98f, .88f, .68f, .45f};
  // Blows that go through what they meet: fastest just before it, hardly slower in it. A captured
  // hook is fastest where it crosses the middle; a tornado kick 0.01 s before its contact.
  static const std::vector<float> kSwing = {.15f, .25f, .38f, .52f, .66f, .79f,
                                            .90f, .98f, 1.0f, .95f, .82f};
  static const std::vector<float> kWhip = {.25f, .31f, .40f, .52f, .66f, .80f,
                                           .92f, .99f, 1.0f, .95f, .82f};
  // A leg that is straightened against something: thrusts are fastest 0.08-0.15 s before the end.
  static const std::vector<float> kThrust = {.22f, .32f, .46f, .62f, .78f, .92f,
                                             1.0f, 1.0f, .92f, .74f, .50f};
  if (name == "swing") return &kSwing;
  if (name == "whip") return &kWhip;
  if (name == "thrust") return &kThrust;
  if (name == "cross") return &kCross;
  if (name == "long_cross") return &kLongCross;
  if (name == "jab") return &kJab;
  if (name == "body") return &kBody;
  if (name == "kick") return &kKick;
  return nullptr;
}

namespace {

// Share of the way covered at 0, 0.1 .. 1 of the time: the profile's integral, trapezoids.
std::vector<float> covered(const std::vector<float>& profile) {
  std::vector<float> share(profile.size(), 0.0f);
  for (std::size_t i = 1; i < profile.size(); ++i) {
    share[i] = share[i - 1] + 0.5f * (profile[i - 1] + profile[i]);
  }
  for (float& s : share) s /= share.back();
  return share;
}

// Centripetal Catmull-Rom between p1 and p2 (Barry, Goldman 1988).
Vec3 catmull_rom(const std::array<Vec3, 4>& p, float u) {
  std::array<float, 4> k{};
  for (std::size_t i = 1; i < 4; ++i) {
    k[i] = k[i - 1] + std::sqrt(std::max(1e-4f, glm::distance(p[i], p[i - 1])));
  }
  const float t = k[1] + u * (k[2] - k[1]);
  const auto lerp = [&](Vec3 a, Vec3 b, float ka, float kb) {
    return a * ((kb - t) / (kb - ka)) + b * ((t - ka) / (kb - ka));
  };
  const Vec3 a1 = lerp(p[0], p[1], k[0], k[1]), a2 = lerp(p[1], p[2], k[1], k[2]);
  const Vec3 a3 = lerp(p[2], p[3], k[2], k[3]);
  const Vec3 b1 = lerp(a1, a2, k[0], k[2]), b2 = lerp(a2, a3, k[1], k[3]);
  return lerp(b1, b2, k[1], k[2]);
}

}  // namespace

StrikePath::StrikePath(const std::vector<float>& times, const std::vector<Vec3>& points,
                       const std::vector<ProfileWindow>& windows) {
  constexpr int kSamples = 24;
  const std::size_t n = points.size();
  std::vector<float> arc_at_key(n, 0.0f);
  arc_.push_back(0);
  dense_.push_back(points.front());
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const Vec3 before = i > 0 ? points[i - 1] : points[i] * 2.0f - points[i + 1];
    const Vec3 after = i + 2 < n ? points[i + 2] : points[i + 1] * 2.0f - points[i];
    for (int k = 1; k <= kSamples; ++k) {
      const Vec3 p =
          catmull_rom({before, points[i], points[i + 1], after}, static_cast<float>(k) / kSamples);
      arc_.push_back(arc_.back() + glm::distance(p, dense_.back()));
      dense_.push_back(p);
    }
    arc_at_key[i + 1] = arc_.back();
  }
  const auto arc_at = [&](float t) {
    std::size_t best = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (std::abs(times[i] - t) < std::abs(times[best] - t)) best = i;
    }
    return arc_at_key[best];
  };
  std::size_t window = 0;
  for (std::size_t i = 0; i < n; ++i) {
    while (window < windows.size() && times[i] > windows[window].start - 1e-4f) {
      const ProfileWindow& w = windows[window];
      const float from = arc_at(w.start), to = arc_at(w.contact);
      const std::vector<float> share = covered(*w.profile);
      for (std::size_t k = 0; k < share.size(); ++k) {
        const float u = static_cast<float>(k) / static_cast<float>(share.size() - 1);
        arc_of_time_.add(w.start + u * (w.contact - w.start),
                         Vec3(from + share[k] * (to - from), 0, 0));
      }
      ++window;
    }
    if (arc_of_time_.empty() || times[i] > arc_of_time_.last_time() + 1e-4f) {
      arc_of_time_.add(times[i], Vec3(arc_at_key[i], 0, 0));
    }
  }
}

Vec3 StrikePath::point(float arc) const {
  const auto after = std::upper_bound(arc_.begin(), arc_.end(), arc);
  if (after == arc_.begin()) return dense_.front();
  if (after == arc_.end()) return dense_.back();
  const auto i = static_cast<std::size_t>(after - arc_.begin());
  const float u = (arc - arc_[i - 1]) / std::max(1e-9f, arc_[i] - arc_[i - 1]);
  return dense_[i - 1] + (dense_[i] - dense_[i - 1]) * u;
}

Vec3 StrikePath::at(float t) const {
  return point(arc_of_time_.at(t).x);
}

void smooth(std::vector<Vec3>& values, float sigma_ticks) {
  const int reach = static_cast<int>(std::ceil(3 * sigma_ticks));
  const int last = static_cast<int>(values.size()) - 1;
  if (reach < 1 || last < 1) return;
  std::vector<float> weight(static_cast<std::size_t>(reach) + 1);
  for (std::size_t k = 0; k < weight.size(); ++k) {
    const float x = static_cast<float>(k) / sigma_ticks;
    weight[k] = std::exp(-0.5f * x * x);
  }
  // Beyond an end the curve goes on point-mirrored about the end's value, which keeps that value.
  const auto value = [&](int i) {
    const auto at = [&](int k) { return values[static_cast<std::size_t>(std::clamp(k, 0, last))]; };
    if (i < 0) return at(0) * 2.0f - at(-i);
    if (i > last) return at(last) * 2.0f - at(2 * last - i);
    return at(i);
  };
  std::vector<Vec3> result(values.size());
  for (int i = 0; i <= last; ++i) {
    Vec3 sum = values[static_cast<std::size_t>(i)];
    float total = 1;
    for (int k = 1; k <= reach; ++k) {
      const float w = weight[static_cast<std::size_t>(k)];
      sum += (value(i - k) + value(i + k)) * w;
      total += 2 * w;
    }
    result[static_cast<std::size_t>(i)] = sum / total;
  }
  values = std::move(result);
}

void smooth(std::vector<Quat>& rotations, float sigma_ticks) {
  if (rotations.size() < 3) return;
  // Turns from tick to tick, summed: between neighbours these average like vectors.
  std::vector<Vec3> turns(rotations.size());
  for (std::size_t i = 1; i < rotations.size(); ++i) {
    const Quat now = in_hemisphere_of(rotations[i], rotations[i - 1]);
    turns[i] = turns[i - 1] + rotation_vector(now * glm::inverse(rotations[i - 1]));
  }
  const std::vector<Vec3> raw = turns;
  smooth(turns, sigma_ticks);
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    rotations[i] = glm::normalize(from_rotation_vector(turns[i] - raw[i]) * rotations[i]);
  }
}

void widen(std::vector<float>& values, int reach) {
  const int last = static_cast<int>(values.size()) - 1;
  std::vector<float> wide(values.size());
  for (int i = 0; i <= last; ++i) {
    float most = 0;
    for (int k = std::max(0, i - reach); k <= std::min(last, i + reach); ++k) {
      most = std::max(most, values[static_cast<std::size_t>(k)]);
    }
    wide[static_cast<std::size_t>(i)] = most;
  }
  // A mean over the same reach of the widened values cannot fall below the input.
  for (int i = 0; i <= last; ++i) {
    float sum = 0;
    for (int k = -reach; k <= reach; ++k)
      sum += wide[static_cast<std::size_t>(std::clamp(i + k, 0, last))];
    values[static_cast<std::size_t>(i)] = sum / static_cast<float>(2 * reach + 1);
  }
}

}  // namespace ringcraft
