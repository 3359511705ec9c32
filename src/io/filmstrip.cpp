#include "io/filmstrip.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace ringcraft {
namespace {

struct Stroke {
  Vec3 from, to;
  float width;  // m
  const char* colour;
};

constexpr const char* kLeftColour = "#2f6fd0";
constexpr const char* kRightColour = "#d04a3a";
constexpr const char* kTrunkColour = "#8a8f98";

std::vector<Stroke> strokes_of(const Skeleton& skeleton, const Pose& pose) {
  const WorldPose world = world_pose(skeleton, pose);
  const auto at = [&](Joint joint) { return world.position[index(joint)]; };
  std::vector<Stroke> out;
  const Vec3 skull = at(Joint::head) + world.rotation[index(Joint::head)] * Vec3(0, 0.11f, 0.01f);
  const Vec3 nose = skull + world.rotation[index(Joint::head)] * Vec3(0, -0.01f, 0.12f);
  out.push_back({at(Joint::hips), at(Joint::spine), 0.24f, kTrunkColour});
  out.push_back({at(Joint::spine), at(Joint::upper_chest), 0.25f, kTrunkColour});
  out.push_back({at(Joint::upper_chest), at(Joint::neck) - Vec3(0, 0.04f, 0), 0.25f, kTrunkColour});
  out.push_back({at(Joint::neck), at(Joint::head), 0.10f, kTrunkColour});
  out.push_back({skull, skull + Vec3(0, 0.02f, 0), 0.19f, "#b9a58f"});
  out.push_back({nose, nose, 0.05f, "#7b5b3a"});
  for (const Side side : {Side::left, Side::right}) {
    const char* colour = side == Side::left ? kLeftColour : kRightColour;
    const Limb a = arm(side);
    const Limb l = leg(side);
    const Vec3 fist =
        at(a.end) + world.rotation[index(a.end)] * Vec3(side == Side::left ? 0.08f : -0.08f, 0, 0);
    const Vec3 tip = at(toes(side)) + world.rotation[index(toes(side))] * Vec3(0, 0, 0.07f);
    out.push_back({at(a.root), at(a.middle), 0.09f, colour});
    out.push_back({at(a.middle), at(a.end), 0.075f, colour});
    out.push_back({at(a.end), fist, 0.11f, colour});
    out.push_back({at(l.root), at(l.middle), 0.14f, colour});
    out.push_back({at(l.middle), at(l.end), 0.10f, colour});
    out.push_back({at(l.end), at(toes(side)), 0.07f, colour});
    out.push_back({at(toes(side)), tip, 0.05f, colour});
  }
  return out;
}

// Where a point falls on the picture: right, up (both m) and depth toward the eye.
Vec3 seen(Vec3 p, bool from_side) {
  if (from_side) return {p.z, p.y, -p.x};
  constexpr float kTurn = radians(25);
  const float right = p.x * std::cos(kTurn) - p.z * std::sin(kTurn);
  return {right, p.y, p.z * std::cos(kTurn) + p.x * std::sin(kTurn)};
}

void draw_figure(const Skeleton& skeleton, const Action& action, Tick tick, bool from_side, float x,
                 float floor, float scale, std::string& svg) {
  const Placement& root = action.clip.root_at(tick);
  std::vector<Stroke> strokes = strokes_of(skeleton, action.clip.at(tick));
  for (Stroke& stroke : strokes) {
    stroke.from = seen(stroke.from - root.position(), from_side);
    stroke.to = seen(stroke.to - root.position(), from_side);
  }
  std::stable_sort(strokes.begin(), strokes.end(), [](const Stroke& a, const Stroke& b) {
    return a.from.z + a.to.z < b.from.z + b.to.z;
  });
  const auto line = [&](const Stroke& s, float width, const char* colour) {
    svg +=
        fmt::format("<path d='M{:.1f} {:.1f}L{:.1f} {:.1f}' stroke='{}' stroke-width='{:.0f}'/>\n",
                    x + s.from.x * scale, floor - s.from.y * scale, x + s.to.x * scale + 0.05f,
                    floor - s.to.y * scale, colour, width * scale);
  };
  for (const Stroke& stroke : strokes) {
    line(stroke, stroke.width + 0.025f, "#ffffff");
    line(stroke, stroke.width, stroke.colour);
  }
  const WorldPose world = world_pose(skeleton, action.clip.at(tick));
  for (const Side side : {Side::left, Side::right}) {
    if (!action.clip.contacts_at(tick).of(side)) continue;
    const Vec3 ball = seen(world.position[index(toes(side))] - root.position(), from_side);
    svg += fmt::format("<rect x='{:.1f}' y='{:.1f}' width='12' height='4' fill='{}'/>\n",
                       x + ball.x * scale - 6, floor + (side == Side::left ? 2.0f : 7.0f),
                       side == Side::left ? "#123a7a" : "#7a1a12");
  }
  // Where the root stands and which way it faces.
  const Vec3 faces = seen(root.forward() * 0.3f, from_side);
  svg += fmt::format(
      "<line x1='{:.1f}' y1='{:.1f}' x2='{:.1f}' y2='{:.1f}' stroke='#000' stroke-width='1.5'/>"
      "<circle cx='{:.1f}' cy='{:.1f}' r='2'/>\n",
      x, floor, x + faces.x * scale, floor, x, floor);
}

std::string heading(const Action& action) {
  std::string text =
      fmt::format("{}  {}  {:.2f} s", action.name, name_of(action.kind), seconds(action.length()));
  const Placement& end = action.clip.root.back();
  text += fmt::format("  root {:+.2f} {:+.2f} m {:+.0f} deg", end.x, end.z, degrees(end.yaw));
  for (const Strike& strike : action.strikes)
    text +=
        fmt::format("  | {} {} {} {:.2f}-{:.2f}", name_of(strike.kind), vrm_name(strike.joint),
                    name_of(strike.zone), seconds(strike.active_begin), seconds(strike.active_end));
  if (action.defense)
    text += fmt::format("  | {} {:.2f}-{:.2f}", name_of(action.defense->kind),
                        seconds(action.defense->begin), seconds(action.defense->end));
  if (action.response)
    text += fmt::format("  | {} steps {} direction {:+.0f}", name_of(action.response->kind),
                        action.response->steps, degrees(action.response->direction));
  if (action.starts_lying != Lying::none)
    text += fmt::format("  | from {}", name_of(action.starts_lying));
  if (action.ends_lying != Lying::none)
    text += fmt::format("  | to {}", name_of(action.ends_lying));
  return text;
}

}  // namespace

std::string filmstrip_svg(const Skeleton& skeleton, const std::vector<Action>& actions,
                          const FilmstripSettings& settings) {
  const float cell = 1.75f * settings.pixels_per_metre;
  const float strip = 2.25f * settings.pixels_per_metre;
  const float row = 2 * strip + 20;
  const int poses = std::max(settings.poses, 2);
  std::string body;
  int rows = 0;
  for (const Action& action : actions) {
    if (action.name.find(settings.only) == std::string::npos) continue;
    const float top = static_cast<float>(rows++) * row;
    body += fmt::format("<text x='6' y='{:.0f}' font-size='13' stroke='none'>{}</text>\n", top + 14,
                        heading(action));
    for (int i = 0; i < poses; ++i) {
      const Tick tick = action.length() * i / (poses - 1);
      const float x = (static_cast<float>(i) + 0.5f) * cell;
      const auto covers = [&](Tick begin, Tick end) { return tick >= begin && tick < end; };
      const bool hits =
          std::any_of(action.strikes.begin(), action.strikes.end(),
                      [&](const Strike& s) { return covers(s.active_begin, s.active_end); });
      const bool guards = action.defense && covers(action.defense->begin, action.defense->end);
      if (hits || guards)
        body += fmt::format(
            "<rect x='{:.0f}' y='{:.0f}' width='{:.0f}' height='{:.0f}' fill='{}'/>\n",
            x - cell / 2 + 1, top + 18, cell - 2, 2 * strip, hits ? "#fdeceb" : "#eaf7ea");
      for (const bool from_side : {true, false}) {
        const float floor =
            top + 20 + (from_side ? 1.0f : 2.0f) * strip - 0.25f * settings.pixels_per_metre;
        body += fmt::format(
            "<line x1='{:.0f}' y1='{:.1f}' x2='{:.0f}' y2='{:.1f}' stroke='#c9ccd1' "
            "stroke-width='1'/>\n",
            x - cell / 2, floor, x + cell / 2, floor);
        draw_figure(skeleton, action, tick, from_side, x, floor, settings.pixels_per_metre, body);
      }
      body += fmt::format(
          "<text x='{:.0f}' y='{:.0f}' font-size='9' fill='#777' stroke='none'>{:.2f}</text>\n",
          x - cell / 2 + 4, top + 28, seconds(tick));
    }
  }
  const float width = cell * static_cast<float>(poses);
  const float height = std::max(1.0f, static_cast<float>(rows) * row);
  return fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{0:.0f}' height='{1:.0f}' "
      "font-family='sans-serif' "
      "stroke-linecap='round'>\n<rect width='{0:.0f}' height='{1:.0f}' "
      "fill='#ffffff'/>\n{2}</svg>\n",
      width, height, body);
}

std::string filmstrip_svg(const MotionLibrary& library, const FilmstripSettings& settings) {
  return filmstrip_svg(library.skeleton(), library.actions(), settings);
}

}  // namespace ringcraft
