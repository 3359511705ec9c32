#include "scene/study_hits.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "base/tasks.h"
#include "physics/stances.h"
#include "physics/trial.h"
#include "scene/study_hits_rows.h"

namespace ringcraft {

HitRows::HitRows() {
  table.columns = {"group", "what", "unit", "measured", "published", "bar", "holds"};
}

void HitRows::said(const std::string& what, const std::string& unit, std::optional<double> measured,
                   const std::string& published) {
  table.rows.push_back(
      {group_, what, unit, cell_of(measured), published, std::string(), std::string()});
}

void HitRows::held(const std::string& what, const std::string& unit, std::optional<double> measured,
                   const std::string& published, const HitBar& bar) {
  const bool holds = measured && *measured >= bar.low && *measured <= bar.high;
  std::string text;
  if (std::isinf(bar.low)) {
    text = fmt::format("<= {:.4g}", bar.high);
  } else if (std::isinf(bar.high)) {
    text = fmt::format(">= {:.4g}", bar.low);
  } else {
    text = fmt::format("{:.4g} .. {:.4g}", bar.low, bar.high);
  }
  missed += measured && !holds ? 1 : 0;
  table.rows.push_back({group_, what, unit, cell_of(measured), published, text,
                        std::string(!measured ? ""
                                    : holds   ? "yes"
                                              : "NO")});
}

StillHit::StillHit(const BodyModel& body, const Pose& pose, Part part, float way, float impulse,
                   float tone)
    : continued(kImpulseStepTicks + 1, pose) {
  const Capsule capsule = capsules(body, world_pose(body.skeleton, pose))[index(part)];
  input.pose = input.pose_before = pose;
  input.continued = continued;
  input.contacts = {true, true};
  input.tone = tone;
  input.blow.part = part;
  input.blow.point = (capsule.a + capsule.b) * .5f;
  input.blow.impulse = impulse * (yaw_rotation(way) * kForward);
  input.blow.effective_mass = 3;
}

int severity(const ImpactOutcome& outcome) {
  if (outcome.response == ResponseKind::knockdown) return 4;
  return outcome.response == ResponseKind::recovery_steps ? outcome.steps : 0;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v / static_cast<double>(values.size());
  return sum;
}

double deviation(const std::vector<double>& values) {
  if (values.size() < 2) return 0;
  const double middle = mean(values);
  double sum = 0;
  for (const double v : values) sum += (v - middle) * (v - middle);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

namespace {

using Clock = std::chrono::steady_clock;

// Least of several runs, microseconds: what the clock adds is left out.
template <class Work>
double microseconds(int runs, const Work& work) {
  double least = 1e12;
  for (int i = 0; i < runs; ++i) {
    const auto begin = Clock::now();
    work();
    least =
        std::min(least, std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
  }
  return least;
}

}  // namespace

StudyTable cost_rows(const HitsAsked& asked) {
  const BodyModel body = make_body({});
  const Pose pose = fighting_stance(body);
  const StillHit hit(body, pose, Part::chest, kPi, 15);
  const ImpactOutcome outcome = impulse_step(body, hit.input);
  float kept = 0;  // so that nothing is left out
  const auto step = [&] { kept += impulse_step(body, hit.input).margin; };
  const double one = microseconds(15, step);
  const double bare = microseconds(15, [&] { kept += bare_loop(body, hit.input); });
  const double shown = microseconds(9, [&] {
    kept += simulate_response(body, hit.input, outcome, hit.continued, 18).back().hips.y;
  });
  const double fall = microseconds(3, [&] {
    const StillHit hard(body, pose, Part::chest, kPi, 170);
    kept +=
        simulate_response(body, hard.input, impulse_step(body, hard.input), {}, 240).back().hips.y;
  });
  constexpr std::size_t kMany = 64;
  std::vector<ImpactOutcome> single(kMany), split(kMany);
  const auto many = [&](int threads, std::vector<ImpactOutcome>& out) {
    run_tasks(kMany, threads, [&](std::size_t i) { out[i] = impulse_step(body, hit.input); });
  };
  const double alone = microseconds(3, [&] { many(1, single); });
  const double two = microseconds(3, [&] { many(2, split); });
  StudyTable table;
  table.columns = {"what", "unit", "measured", "asked"};
  table.rows = {
      {std::string("one impulse step, absorbed"), std::string("us"), one, std::string()},
      {std::string("the engine alone, the same ragdoll and steps"), std::string("us"), bare,
       std::string()},
      {std::string("impulse step over the engine alone"), std::string(), one / bare,
       std::string("<= 1.15")},
      {std::string("shown response of 150 ms"), std::string("us"), shown, std::string()},
      {std::string("decision and shown fall of 2 s"), std::string("us"), fall, std::string()},
      {std::string("64 impulse steps, one thread over two"), std::string(), alone / two,
       std::string(">= 1.7")},
      {std::string("same bits on two threads"), std::string(),
       static_cast<std::int64_t>(single == split), std::string("1")},
      {std::string("checksum"), std::string(), static_cast<double>(kept), std::string()}};
  asked.run.say("cost measured");
  return table;
}

namespace {

constexpr const char* kCost = "cost";

struct Question {
  const char* name;
  void (*ask)(const HitsAsked&, HitRows&);
};
constexpr Question kQuestions[] = {{"strikes", strike_rows},       {"balance", balance_rows},
                                   {"decision", decision_rows},    {"recovery", recovery_rows},
                                   {"seen", answer_rows},          {"laws", law_rows},
                                   {"robustness", robustness_rows}};

bool is_asked(const HitsSettings& settings, const std::string& name) {
  const std::vector<std::string>& only = settings.only;
  return only.empty() || std::find(only.begin(), only.end(), name) != only.end();
}

}  // namespace

std::vector<std::string> hit_questions() {
  std::vector<std::string> names;
  for (const Question& question : kQuestions) names.emplace_back(question.name);
  names.emplace_back(kCost);
  return names;
}

HitsStudy hits_study(const MotionLibrary& library, const HitsSettings& settings,
                     const StudyRun& run) {
  HitRows rows;
  const HitsAsked asked{library, settings, run};
  HitsStudy out;
  for (const Question& question : kQuestions) {
    if (!is_asked(settings, question.name)) continue;
    const HitRows before = rows;
    question.ask(asked, rows);
    if (!run.stopped()) continue;
    rows = before;  // of what was not finished nothing is said
    break;
  }
  out.study.interrupted = run.stopped();
  out.study.name = "hits";
  out.study.title = "Hits against published figures: " + library.name();
  out.study.said = {
      fmt::format("library {}, {} random hits a question, seed {}; the standing body is 1.78 m and "
                  "75 kg unless a row says otherwise",
                  library.name(), settings.count, settings.seed)};
  out.study.table = std::move(rows.table);
  out.missed = rows.missed;
  if (!out.study.interrupted && is_asked(settings, kCost)) out.study.timing = cost_rows(asked);
  return out;
}

}  // namespace ringcraft
