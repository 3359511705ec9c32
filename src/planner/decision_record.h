#pragma once
// What a decision says of itself: its lines with what they are worth by term, the first moves that
// rules struck off, and what is foreseen along the chosen line.

#include "planner/horizon_search.h"

namespace ringcraft {

DecisionRecord decision_record(const DuelSetup& setup, const FightState& state,
                               const Searched& searched);

// What the chosen line says will happen: its moves are played again and their events written down.
std::vector<Event> foreseen_events(const DuelSetup& setup, const FightState& state,
                                   const Searched& searched);

// `foreseen` as a timeline would tell it; `node` is the one that followed it.
Event event_of(const DuelEvent& foreseen, const DuelSetup& setup, const DuelNode& node);

}  // namespace ringcraft
