#pragma once
// The duel as a game: temporal expansion (the paper's section on it; docs/planning.md).
//
// A node is a moment at which somebody acts; an edge is an action, and lasts until the next
// decision or the first hit. Side 0 plans (maximizes), side 1 is its chief opponent. Other fighters
// do what they have already begun: obstacles and threats. One of those whose chief opponent the
// planner is may reply once it is free: with the attack that is worst for the planner, or not at
// all (after the Best-Reply Search of Schadd and Winands 2011). It is number 2 + its index.

#include <array>
#include <optional>
#include <span>

#include "planner/bearings.h"
#include "planner/evaluation.h"
#include "planner/fallen.h"
#include "planner/habits.h"
#include "planner/impact_memo.h"
#include "planner/plan.h"
#include "planner/protection.h"
#include "planner/search.h"
#include "planner/search_cost.h"

namespace ringcraft {

inline constexpr float kMostAttackAim = radians(15);  // a blow's correction at its launch
inline constexpr float kMostAim = radians(25);        // of anything else
inline constexpr float kBackTurned = radians(100);    // farther off the opponent shows the back
inline constexpr Tick kLocationEvery = 6;             // ticks between samples of F_loc

// One fighter in the tree.
struct Duelist {
  InFlight flight;
  std::int32_t health = 0;   // thousandths of a point
  std::int32_t balance = 0;  // as FighterState::balance
  bool last_at_tie = false;
  bool knocked_out = false;
  std::array<ActionId, kLongestPath> queue{};  // the rest of a chosen path; invalid: none
  ActionId pending;         // the response that a forced node will launch; invalid otherwise
  float pending_share = 1;  // Launch::share of it
};

struct DuelNode {
  Tick now = 0;
  std::array<Duelist, 2> side;
  std::int32_t gained = 0;        // f along the route so far, thousandths
  std::uint64_t threats_met = 0;  // bit 4 * other + strike: one of another's first four has landed
  Tick checked = 0;               // up to where the last edge was looked at for penetration
  std::int32_t too_deep = 0;      // and what its mover is blamed for until there
  Duelist reply;                  // the bystander that has replied
  std::int32_t replier = -1;      // which, an index into DuelSetup::others
  std::int32_t asked = 0;         // of DuelSetup::repliers, those that have had their choice
};

struct DuelMove {
  ActionId action;
  std::uint8_t side = 0;
  bool forced = false;
  const NextAction* next = nullptr;  // null where forced, and where no reply is made
  std::int32_t unusual = 0;  // thousandths: what it costs side 1 that this is no habit of it
  ActionId first() const {   // what is launched: the path's first action where there is one
    return next != nullptr && !next->path.empty() ? next->path.front() : action;
  }
  bool passes() const { return !forced && next == nullptr; }  // `action` goes on
};

// A fighter outside the duel.
struct Bystander {
  InFlight flight;
  FighterId id;
  int body = 0;   // index into the memo's tables
  int team = -1;  // Contender::team

  bool lies() const { return flight.table->action->ends_lying != Lying::none; }  // or falls
};

// What a search needs to know of one side. Constant inside a search.
struct SideSetup {
  const MotionTables* tables = nullptr;
  const MotionTables* paced = nullptr;  // of what it launches, at its pace; null: at the clips'
  float tone = 1.0f;                    // of its muscles where the motion in flight says nothing
  int body = 0;                         // index into the memo's tables
  int team = -1;                        // Contender::team
  FighterId id;
  const ActionTable* in_flight = nullptr;  // of its launch as it is shown; null: its clip's
  const Style* style = nullptr;
  Weights weights;
  std::vector<std::int32_t> launch;  // F_control of each action, thousandths
  // Of each strike of the tables (ActionTable::first_strike) on the other side.
  std::span<const std::int32_t> clean_damage;

  const MotionTables& launches() const { return paced != nullptr ? *paced : *tables; }
};

// A fighter outside the duel that may reply when it is free.
struct Replier {
  int other = 0;     // index into DuelSetup::others
  Duelist now;       // at the root
  SideSetup choice;  // what it may launch, and what that costs

  Tick free() const { return now.flight.launch.end; }
};

// What side 1 is expected to do about a feint that side 0 begins at the root, where it must act
// before it can tell the feint from its attack: what it would do about the attack.
struct FeintAnswer {
  ActionId feint;   // of side 0
  Tick start = 0;   // when it begins
  Tick acts = 0;    // when side 1 must act
  ActionId answer;  // what it chooses then
};

struct DuelSetup {
  std::array<SideSetup, 2> side;
  LeafFactors factors;
  const Habits* habits = nullptr;    // of side 1, where side 0 learns
  double learning = 0;               // Style::learning of side 0
  std::optional<FeintAnswer> feint;  // one that would take side 1 in
  PlanSettings settings;
  const Protection* protection = nullptr;
  ImpactMemo* memo = nullptr;
  std::vector<Bystander> others;
  std::vector<Replier> repliers;  // in the order in which they are free
  std::vector<Fallen> fallen;     // those of them that lie, or will when their fall is over
  SearchCost* cost = nullptr;     // where the time went, for one thread; null: nobody asks
};

// Something that happened on the way; written down when a line is replayed.
struct DuelEvent {
  Tick tick = 0;
  int attacker = 0;  // side; 2 + index of a bystander
  int victim = 0;
  ActionId attack;
  std::size_t strike = 0;
  enum class Kind : std::uint8_t { hit, block, evaded } kind = Kind::hit;
  LandedBlow blow;
  ImpactAnswer answer;
};

// The terms of the evaluation, for each side by themselves, written down for whoever asks why.
enum class Term : std::uint8_t { location, hit, defense, control };
inline constexpr std::size_t kTerms = 4;
struct TermSum {
  double points = 0;          // in the side's own S
  std::int32_t credited = 0;  // to the planner's f, thousandths
};
using DuelTerms = std::array<std::array<TermSum, kTerms>, 2>;  // by side and term

struct DuelCounts {
  std::uint64_t unanswered_hit = 0, back_turned = 0, penetration = 0, candidates = 0;
  DuelCounts& operator+=(const DuelCounts& o);
  DuelCounts operator-(const DuelCounts& o) const;
};

// Of a side, or of 2 + an index of a bystander.
inline FighterId id_of(const DuelSetup& setup, int who) {
  return who < 2 ? setup.side[static_cast<std::size_t>(who)].id
                 : setup.others[static_cast<std::size_t>(who - 2)].id;
}

class Duel {
 public:
  using Node = DuelNode;
  using Move = DuelMove;

  Duel(const DuelSetup& setup, Tick horizon);

  // The root of the tree in which `planner` decides at state.now.
  static Node root(const DuelSetup& setup, const FightState& state);

  bool terminal(const Node& node) const { return node.now >= horizon_; }
  Actor actor(const Node& node) const;
  std::int32_t value(const Node& node) const { return node.gained; }
  std::int32_t gained(const Node& node) const { return node.gained; }
  std::uint64_t hash(const Node& node) const;
  // Where no blow can land or be evaded any more, whoever launches what: what locations and
  // launches can still bring. Anything elsewhere.
  ValueRange range(const Node& node) const;
  void moves(const Node& node, std::vector<Move>& moves);
  Child<Node> apply(const Node& node, const Move& move);
  // The same in two parts: check() adds to the fault how far bodies penetrate on the way.
  Child<Node> step(const Node& node, const Move& move);
  void check(const Node& node, const Move& move, Child<Node>& child);
  // A child that a shorter horizon cut off is played on to this one; false where what comes later
  // changes what came before.
  bool resume(const Node& node, const Move& move, Child<Node>& child);
  std::uint32_t key(const Move& move) const {
    return static_cast<std::uint32_t>(move.action.value) * 2 + move.side;
  }

  const DuelCounts& counts() const { return counts_; }
  void count(const DuelCounts& counts) { counts_ += counts; }
  void record_into(std::vector<DuelEvent>* events) { events_ = events; }
  void record_terms_into(DuelTerms* terms) { terms_ = terms; }
  void record_turned_into(std::vector<ActionId>* turned) { turned_ = turned; }  // back_turned
  Tick horizon() const { return horizon_; }

  // Plays the actions in flight, with nobody deciding, until the first of them ends or is cut.
  void play_on(Node& node);

  // Who launches what `who` does: a side, or 2 + an index of a bystander that may reply.
  const Duelist& duelist(const Node& node, int who) const;

  // The side whose action ends first; at equal ends the one that was second at the last tie.
  int next_side(const Node& node) const;

 private:
  // Ticks over which one strike may meet one body before the next decision.
  struct Window {
    int attacker = 0;  // side; 2 + index of a bystander
    int victim = 0;    // the same; a bystander only where it is a team mate
    std::size_t strike = 0;
    const InFlight* flight = nullptr;
    Tick from = 0, to = 0;  // both included
    bool same_strike(const Window& o) const { return attacker == o.attacker && strike == o.strike; }
  };
  struct Met {
    Window window;
    Contact contact;
    Tick tick = 0;
  };
  struct Aspect;  // what candidates are weighed against; candidates.cpp

  // A side, or 2 + an index of a bystander that may reply.
  const SideSetup& side(int i) const {
    return i < 2 ? setup_->side[static_cast<std::size_t>(i)] : replier(i - 2).choice;
  }
  static constexpr int against(int who) { return who == 0 ? 1 : 0; }
  const Replier& replier(int other) const;
  const InFlight& bystander(const Node& node, std::size_t other) const {
    const bool replied = node.replier == static_cast<std::int32_t>(other);
    return replied ? node.reply.flight : setup_->others[other].flight;
  }
  const InFlight& flight_of(const Node& node, int who) const {
    return who < 2 ? node.side[static_cast<std::size_t>(who)].flight
                   : bystander(node, static_cast<std::size_t>(who - 2));
  }
  // `who`: a side, or 2 + an index of a bystander.
  bool may_strike_each_other(int who, std::size_t other) const;
  Tick next_reply(const Node& node) const;  // when somebody is to be asked; kNever: nobody
  bool asks(const Node& node) const;        // whether somebody is, now
  void find_replies(const Node& node, std::vector<Move>& moves);
  void reply(Node& node, const Move& move) const;
  static Tick sides_end(const Node& node);  // the first end of the two sides' actions
  Tick next_end(const Node& node) const { return std::min(sides_end(node), horizon_); }
  void credit(Node& node, int side, double points, Term term) const;
  void note_term(int side, Term term, double points, std::int32_t credited) const;
  void launch_forced(Node& node, int side, ActionId action) const;
  void launch_aimed(Node& node, int side, const NextAction& next) const;
  void launch_chosen(Node& node, const Move& move) const;

  // From node.now to the next decision, hit or horizon; the fault is what the mover is blamed for.
  std::int32_t advance(Node& node, const Move& move);
  void find_windows(const Node& node, Tick end);
  void note_met(const Met& met);
  Tick meet(Node& node, Tick end, const Move& move, std::int32_t& fault);
  DuelEvent event_of(const Node& node, const Met& met) const;
  void credit_landed(Node& node, const DuelEvent& event, bool knocks_down);
  bool unanswered(const Node& node, const DuelEvent& event, const InFlight& attacker,
                  const Move& move) const;
  void land(Node& node, const Met& met, const Move& move, std::int32_t& fault);
  void judge_evasions(Node& node, Tick from, Tick to);
  void add_location(Node& node, Tick from, Tick to) const;
  std::int32_t penetration_fault(const Node& node, int mover, Tick from, Tick to) const;
  // The same of its whole launch, against those outside the duel who are in nobody's edge: who
  // lies, and team mates.
  std::int32_t launch_fault(const Node& node, int who) const;
  bool may_strike(const InFlight& flight, Tick after) const;
  // The largest share, 0..1, to which a strike of `next`, chosen now, reaches the opponent where
  // that goes by itself.
  float reach_of(const Node& node, int who, const NextAction& next) const;

  const DuelSetup* setup_;
  Tick horizon_;
  struct LaunchRange {  // F_control of whatever a side launches, points
    double least = 0, most = 0;
  };
  std::array<LaunchRange, 2> launches_;
  DuelCounts counts_;
  std::vector<DuelEvent>* events_ = nullptr;
  DuelTerms* terms_ = nullptr;
  std::vector<ActionId>* turned_ = nullptr;
  std::vector<Window> windows_;  // of meet()
  std::vector<Met> met_;
  struct Scored {
    std::int32_t score;
    const NextAction* next;
    bool taken;
    float apart;               // m: how far the roots are apart when it is over
    std::int32_t unusual = 0;  // DuelMove::unusual
    bool better_than(const Scored& o) const {
      return score != o.score ? score > o.score : next->to < o.next->to;
    }
  };
  std::vector<Scored> scored_, picked_, foreseen_;  // of moves(); the first by Choice
  std::vector<NextLanes::Lanes> then_x_, then_z_;   // world: the opponent's root when each is over
  std::vector<BearingLanes> bearings_;
  std::vector<double> saved_;  // points, of each that may follow

  Aspect aspect_of(const Node& node, int side) const;
  void score_candidates(const Node& node, int side);
  void pick_replies(const Node& node, int who, std::size_t attacks);
  void pick_candidates(std::size_t most, const std::array<std::size_t, kChoices>& choices,
                       bool threatened);
  void foresee_habit(const Node& node, std::size_t most);
  double unusual(int count, int most_seen) const;
  void foresee_taken_in(const Node& node);
};
static_assert(Game<Duel>);

}  // namespace ringcraft
