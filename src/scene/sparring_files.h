#pragma once
// What comes out of sparring: the records as CSV, the offense/defense table as JSON and as a page.
// `actions`: what the ids of records and table index; `name`: of the library or the captures.

#include <span>
#include <string>
#include <vector>

#include "motion/action.h"
#include "motion/offense_defense_table.h"

namespace ringcraft {

// One line a record: attack, defense, offset_s, distance_m, bearing_deg, facing_deg, end.
std::string records_csv(std::span<const Action> actions, std::span<const SparringRecord> records);

// Attack by attack the defenses, best first, with launches, successes, best timing and lift.
std::string table_json(const std::string& name, std::span<const Action> actions,
                       const OffenseDefenseTable& table);

// A page: attacks by defenses, each field as green as the defense is sure at its best timing.
std::string table_page(const std::string& name, std::span<const Action> actions,
                       const OffenseDefenseTable& table);

// The table of that page alone, with what it says.
std::string table_html(std::span<const Action> actions, const OffenseDefenseTable& table);

// A line for each kind of blow: of each kind of defense the one that is surest against it at its
// best timing, with the mean share over these attacks.
std::string table_text(std::span<const Action> actions, const OffenseDefenseTable& table);

}  // namespace ringcraft
