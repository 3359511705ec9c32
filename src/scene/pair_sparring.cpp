#include "scene/pair_sparring.h"

#include <algorithm>
#include <span>

#include "physics/contact.h"

namespace ringcraft {

namespace {

constexpr Tick kEarlier = 30;  // 250 ms: a defense launched before that answers something else

BodyCapsules capsules_at(const BodyModel& body, const Clip& clip, Tick tick) {
  return capsules(body, world_pose(body.skeleton, scaled(clip.at(tick), body.scale)));
}

// What came of these blows of the attack, tested in turn, each once.
ExchangeEnd outcome(const BodyModel& body, const PairMove& attack, std::span<const Strike> strikes,
                    const Clip& attacker, const Clip& defender) {
  bool blocked = false;
  for (const Strike& strike : strikes) {
    const Tick first = attack.begin + strike.active_begin;
    SweptBody striker, target;
    striker.after = capsules_at(body, attacker, first - 1);
    target.after = capsules_at(body, defender, first - 1);
    for (Tick tick = first; tick < attack.begin + strike.active_end; ++tick) {
      striker.before = striker.after;
      target.before = target.after;
      striker.after = capsules_at(body, attacker, tick);
      target.after = capsules_at(body, defender, tick);
      const auto contact = strike_contact(striker, strike, target);
      if (!contact) continue;
      if (!contact->blocked) return ExchangeEnd::struck;
      blocked = true;
      break;
    }
  }
  return blocked ? ExchangeEnd::blocked : ExchangeEnd::evaded;
}

Tick over_at(const PairMove& attack) {
  Tick over = 0;
  for (const Strike& strike : attack.action->strikes) over = std::max(over, strike.active_end);
  return attack.begin + over;
}

}  // namespace

std::vector<SparringRecord> pair_records(const BodyModel& body, const PairTake& attacker,
                                         const PairTake& defender) {
  std::vector<SparringRecord> records;
  for (const PairMove& attack : attacker.moves) {
    if (!attack.action->attacks()) continue;
    for (const PairMove& answer : defender.moves) {
      if (!answer.action->defense || answer.begin < attack.begin - kEarlier ||
          answer.begin >= over_at(attack))
        continue;
      SparringRecord record;
      record.attack = attack.id;
      record.defense = answer.id;
      record.offset = answer.begin - attack.begin;
      record.relative = inverse(attack.root) * answer.root;
      const std::span<const Strike> strikes = attack.action->strikes;
      record.end = outcome(body, attack, strikes, *attacker.clip, *defender.clip);
      record.first = outcome(body, attack, strikes.first(1), *attacker.clip, *defender.clip);
      records.push_back(record);
    }
  }
  return records;
}

}  // namespace ringcraft
