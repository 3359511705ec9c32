#include "scene/library_check_seams.h"

#include <algorithm>
#include <array>

#include "motion/playback.h"

namespace ringcraft {

namespace {

constexpr Tick kFrame = 2;    // ticks of a frame of 60 Hz
constexpr Tick kBefore = 12;  // ticks of the first action that are shown
constexpr Tick kAfter = 12;   // ticks of the second one
constexpr float kRate = static_cast<float>(kTicksPerSecond) / kFrame;

using Jumps = std::array<float, kJointCount>;  // m/s between two frames, by joint

// The change of every joint's velocity about frames one frame apart.
Jumps jumps(const WorldPose& a, const WorldPose& b, const WorldPose& c) {
  Jumps out;
  for (std::size_t j = 0; j < kJointCount; ++j)
    out[j] = glm::length(c.position[j] - 2.0f * b.position[j] + a.position[j]) * kRate;
  return out;
}

// What a clip does itself within the ticks, joint by joint.
Jumps own_jumps(const Skeleton& skeleton, const Clip& clip, Tick from, Tick to) {
  Jumps most{};
  std::vector<WorldPose> shown;
  shown.reserve(static_cast<std::size_t>(to - from) + 1);
  for (Tick t = from; t <= to; ++t) shown.push_back(world_pose(skeleton, clip.at(t)));
  for (std::size_t i = 2 * kFrame; i < shown.size(); ++i) {
    const Jumps now = jumps(shown[i - 2 * kFrame], shown[i - kFrame], shown[i]);
    for (std::size_t j = 0; j < kJointCount; ++j) most[j] = std::max(most[j], now[j]);
  }
  return most;
}

class Ends {
 public:
  Ends(const Skeleton& skeleton, const Action& action)
      : start(own_jumps(skeleton, action.clip, 0, std::min(kAfter, action.length()))),
        end(own_jumps(skeleton, action.clip, std::max<Tick>(0, action.length() - kBefore),
                      action.length())) {}
  Jumps start, end;
};

SeamMeasures measure_seam(const MotionLibrary& library, ActionId from, const Edge& edge,
                          const std::vector<Ends>& ends) {
  const Skeleton& skeleton = library.skeleton();
  const Action &first = library.action(from), &second = library.action(edge.to);
  const Placement placement = first.clip.root_at(first.length()) * edge.alignment.placement;
  SeamMeasures seam;
  seam.from = from;
  seam.to = edge.to;
  Playback playback(skeleton);
  std::array<WorldPose, 2 * kFrame + 1> last;  // shown, by tick modulo its size
  Tick shown = 0;
  const auto show = [&](const Pose& pose, FootContacts contacts) {
    last[static_cast<std::size_t>(shown++) % last.size()] =
        world_pose(skeleton, playback.next(pose, contacts));
  };
  const auto before = [&](Tick ticks) -> const WorldPose& {
    return last[static_cast<std::size_t>(shown - 1 - ticks) % last.size()];
  };
  for (Tick t = std::max<Tick>(0, first.length() - kBefore); t <= first.length(); ++t)
    show(first.clip.at(t), first.clip.contacts_at(t));
  playback.stitch(placed(second.clip.at(1), placement), placed(second.clip.at(2), placement));
  for (Tick t = 1; t <= std::min(kAfter, second.length()); ++t) {
    show(placed(second.clip.at(t), placement), second.clip.contacts_at(t));
    if (shown <= 2 * kFrame) continue;
    const Jumps now = jumps(before(2 * kFrame), before(kFrame), before(0));
    for (std::size_t j = 0; j < kJointCount; ++j) {
      const float own = std::max(ends[from.at()].end[j], ends[edge.to.at()].start[j]);
      if (static_cast<double>(now[j] - own) <= seam.jump) continue;
      seam.jump = static_cast<double>(now[j] - own);
      seam.joint = static_cast<Joint>(j);
    }
  }
  return seam;
}

}  // namespace

double own_jump(const Skeleton& skeleton, const Clip& clip) {
  const Jumps all = own_jumps(skeleton, clip, 0, clip.length());
  return static_cast<double>(*std::max_element(all.begin(), all.end()));
}

std::vector<SeamMeasures> measure_seams(const MotionLibrary& library) {
  std::vector<Ends> ends;
  ends.reserve(library.actions().size());
  for (const Action& action : library.actions()) ends.emplace_back(library.skeleton(), action);
  std::vector<SeamMeasures> all;
  for (std::size_t i = 0; i < library.actions().size(); ++i) {
    if (library.actions()[i].ends_lying != Lying::none) continue;  // the ragdoll lies there
    for (const Edge& edge : library.machine().edges(ActionId(i)))
      all.push_back(measure_seam(library, ActionId(i), edge, ends));
  }
  return all;
}

}  // namespace ringcraft
