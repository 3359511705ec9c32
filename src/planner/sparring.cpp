#include "planner/sparring.h"

#include <algorithm>
#include <map>
#include <optional>
#include <thread>

#include "planner/duel.h"

namespace ringcraft {

namespace {

constexpr float kNearest = 0.4f, kFarthest = 3.0f, kStep = 0.02f;  // m between the roots

// What the defender does: stands, defends once, stands on.
struct Reply {
  ActionId defense;  // invalid: only stands
  Tick offset = 0;
};

// What came of a whole attack, and of its first blow alone.
struct Exchange {
  ExchangeEnd end = ExchangeEnd::evaded, first = ExchangeEnd::evaded;
};

class AttackSparring {
 public:
  AttackSparring(const MotionTables& attacker, const MotionTables& defender, ActionId attack,
                 const SparringSettings& settings)
      : attacker_(attacker), defender_(defender), attack_(attack), settings_(settings) {}

  // Records of this attack against who stands in `idle`; empty where it lands on no such guard.
  std::vector<SparringRecord> run(ActionId idle) {
    idle_ = idle;
    std::vector<SparringRecord> records;
    for (const float bearing : {-settings_.most_bearing, 0.0f, settings_.most_bearing}) {
      for (const float distance : landing_distances(bearing)) {
        const Placement relative{0, distance, kPi + bearing};
        for (const ActionId defense : defenses()) add(relative, defense, records);
      }
    }
    return records;
  }

 private:
  std::vector<ActionId> defenses() const {
    std::vector<ActionId> found;
    const Stance stance = defender_.library().action(idle_).stance;
    for (const ActionId id : defender_.library().launchable()) {
      const Action& action = defender_.library().action(id);
      if (action.defense && action.stance == stance) found.push_back(id);
    }
    return found;
  }

  const StrikeTable& first_blow() const { return attacker_.at(attack_).strikes.front(); }

  void add(const Placement& relative, ActionId defense, std::vector<SparringRecord>& records) {
    const Tick latest = first_blow().strike.active_begin;
    for (Tick offset = -settings_.earliest; offset <= latest; offset += settings_.offset_step) {
      const Exchange exchange = outcome(relative, {defense, offset});
      records.push_back({attack_, defense, offset, relative, exchange.end, exchange.first});
    }
  }

  // At most `settings.distances`, evenly over the longest stretch on which the blow lands.
  std::vector<float> landing_distances(float bearing) {
    std::vector<float> longest, stretch;
    for (int i = 0; kNearest + kStep * static_cast<float>(i) <= kFarthest; ++i) {
      const float distance = kNearest + kStep * static_cast<float>(i);
      if (lands({0, distance, kPi + bearing})) {
        stretch.push_back(distance);
        if (stretch.size() > longest.size()) longest = stretch;
      } else {
        stretch.clear();
      }
    }
    const auto wanted = static_cast<std::size_t>(std::max(1, settings_.distances));
    if (longest.size() <= wanted) return longest;
    std::vector<float> spread;
    spread.reserve(wanted);
    for (std::size_t i = 0; i < wanted; ++i)
      spread.push_back(longest[(2 * i + 1) * longest.size() / (2 * wanted)]);
    return spread;
  }

  // The first blow meets the zone it is made for, out of the air, of a fighter that only stands.
  bool lands(const Placement& relative) const {
    const StrikeTable& blow = first_blow();
    const InFlight attack =
        launched(attacker_, attack_, 0, {}, relative.position(), kMostAttackAim);
    const std::vector<InFlight> targets = flights(relative, {}, blow.strike.active_end);
    const std::optional<Met> met = meets(attack, blow, targets);
    if (!met || met->blocked || zone_of(met->contact.struck) != blow.strike.zone) return false;
    return met->tick > blow.strike.active_begin || met->contact.share > 0;
  }

  InFlight launched(const MotionTables& tables, ActionId action, Tick start,
                    const Placement& placement, Vec3 target, float most_aim) const {
    Launch launch;
    launch.action = action;
    launch.start = start;
    launch.end = start + tables.at(action).length;
    launch.placement = placement;
    launch.aim =
        aim_at(*tables.at(action).action, placement, target, tables.body().scale, most_aim);
    return {tables, launch};
  }

  // The defender's flights in order: each ends where the next one begins.
  std::vector<InFlight> flights(const Placement& relative, const Reply& answer, Tick last) const {
    std::vector<InFlight> all;
    const Tick idle_length = defender_.at(idle_).length;
    Placement root = relative;
    Tick now = std::min<Tick>(answer.defense.valid() ? answer.offset : 0, 0);
    const auto fly = [&](ActionId action, Tick until) {
      const bool stands = action == idle_;
      all.push_back(launched(defender_, action, now, root, Vec3{}, stands ? 0.0f : kMostAim));
      now = std::min(until, all.back().launch.end);
      all.back().launch.end = now;
      root = all.back().root_at(now);
    };
    while (answer.defense.valid() && now < answer.offset)
      fly(idle_, std::min(answer.offset, now + idle_length));
    if (answer.defense.valid()) fly(answer.defense, now + defender_.at(answer.defense).length);
    while (now <= last) fly(idle_, now + idle_length);
    return all;
  }

  Exchange outcome(const Placement& relative, const Reply& answer) const {
    const InFlight attack =
        launched(attacker_, attack_, 0, {}, relative.position(), kMostAttackAim);
    const auto& strikes = attack.table->strikes;
    Tick last = 0;
    for (const StrikeTable& strike : strikes) last = std::max(last, strike.strike.active_end);
    const std::vector<InFlight> targets = flights(relative, answer, last);
    Exchange exchange;
    for (const StrikeTable& strike : strikes) {
      const std::optional<Met> met = meets(attack, strike, targets);
      const ExchangeEnd end = !met           ? ExchangeEnd::evaded
                              : met->blocked ? ExchangeEnd::blocked
                                             : ExchangeEnd::struck;
      if (&strike == &strikes.front()) exchange.first = end;
      exchange.end = std::max(exchange.end, end);
      if (end == ExchangeEnd::struck) break;
    }
    return exchange;
  }

  struct Met {
    Contact contact;
    Tick tick = 0;
    bool blocked = false;
  };
  // The first contact of a blow.
  static std::optional<Met> meets(const InFlight& attack, const StrikeTable& strike,
                                  const std::vector<InFlight>& targets) {
    std::size_t at = 0;
    for (Tick tick = strike.strike.active_begin; tick < strike.strike.active_end; ++tick) {
      while (at + 1 < targets.size() && targets[at].launch.end < tick) ++at;
      if (!may_reach(attack, strike, targets[at])) continue;
      if (const auto contact = contact_at(attack, strike, targets[at], tick))
        return Met{*contact, tick, contact->blocked};
    }
    return std::nullopt;
  }

  const MotionTables& attacker_;
  const MotionTables& defender_;
  ActionId idle_, attack_;
  const SparringSettings& settings_;
};

std::vector<ActionId> idles_of(const MotionLibrary& library, std::size_t most_of_a_stance) {
  std::vector<ActionId> idles;
  std::map<Stance, std::size_t> found;
  for (const ActionId id : library.launchable()) {
    const Action& action = library.action(id);
    if (action.kind == Kind::idle && ++found[action.stance] <= most_of_a_stance) {
      idles.push_back(id);
    }
  }
  return idles;
}

}  // namespace

Sparring spar(const MotionTables& attacker, const MotionTables& defender,
              const SparringSettings& settings) {
  Sparring sparring;
  const std::vector<ActionId> idles = idles_of(defender.library(), settings.idles);
  std::vector<ActionId> attacks;
  for (const ActionId id : attacker.library().launchable())
    if (attacker.library().action(id).attacks()) attacks.push_back(id);

  std::vector<std::vector<SparringRecord>> found(attacks.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < attacks.size(); i = next++) {
      AttackSparring one(attacker, defender, attacks[i], settings);
      for (const ActionId idle : idles) {
        if (settings.interrupted != nullptr && *settings.interrupted) return;
        const std::vector<SparringRecord> records = one.run(idle);
        found[i].insert(found[i].end(), records.begin(), records.end());
      }
    }
  };
  std::vector<std::jthread> threads;
  for (int i = 1; i < settings.threads; ++i) threads.emplace_back(work);
  work();
  threads.clear();

  for (std::size_t i = 0; i < attacks.size(); ++i) {
    if (found[i].empty()) sparring.unlanded.push_back(attacks[i]);
    sparring.records.insert(sparring.records.end(), found[i].begin(), found[i].end());
  }
  return sparring;
}

}  // namespace ringcraft
